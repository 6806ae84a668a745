#include "sim/sensor/shared_walks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <variant>

#include "core/parallel.h"
#include "sim/render/light_walk.h"
#include "sim/render/radiance.h"
#include "sim/render/world_space.h"

namespace fathom {
namespace {

constexpr std::uint64_t kSharedWalkStream = 0x736861726564ULL;
constexpr std::uint64_t kMirrorStream = 0x6d6972726fULL;
constexpr std::uint64_t kShiftStream = 0x7368696674ULL;

/// Of diffuse surfaces: pixels to each side that share.
constexpr int kAsideOnSurface = 5;

int parity_of(int x, int y) { return (x & 1) + 2 * (y & 1); }

/// The farther apart light enters and leaves, the less of it still shows dots, and the more walks bring out as much.
int walks_into(const Turbid& medium, double dots_apart) {
  constexpr double kOfEachStep = 6.0;
  constexpr int kLeast = 3, kMost = 12;
  const double path = 1.0 / (medium.scattering * (1.0 - medium.anisotropy));
  return static_cast<int>(std::clamp(std::round(kOfEachStep * path / dots_apart), 1.0 * kLeast, 1.0 * kMost));
}

/// What the light of a walk is in proportion to.
double gain_of(const SeenPoint& seen) { return seen.transmittance * (seen.entered ? 1.0 : seen.albedo); }

bool has_glaze(const Geometry& geometry) {
  return std::any_of(geometry.surfaces.begin(), geometry.surfaces.end(),
                     [](const Surface& surface) { return std::holds_alternative<Glazed>(surface.optics); });
}

}  // namespace

SharedWalks::SharedWalks(const PointLight& projector, const Rig& rig, const BlurredPattern& pattern,
                         const WalkSharing& sharing, std::uint64_t seed, int rows_at_once)
    : projector_(projector),
      rig_(rig),
      pattern_(pattern),
      sharing_(sharing),
      room_(sharing.aside + sharing.knot_distance),
      seed_(seed),
      has_glaze_(has_glaze(projector.world().geometry())),
      width_(rig.sensor.ir_width),
      height_(rig.sensor.ir_height),
      rows_(rig.sensor.ir_height) {
  const int rows = std::min(rows_at_once + 2 * room_, height_);
  entries_[straight] = Image<Entry>(width_, rows);
  if (sharing.is_exact) entries_[mirrored] = Image<Entry>(width_, rows);
  for (std::vector<char>& of_rows : holds_any_) of_rows.resize(rows);
}

void SharedWalks::prepare(int begin, int end) {
  if (begin != prepared_) walked_ = std::max(begin - room_, 0);
  prepared_ = end;
  for (; forgotten_ < begin - room_; ++forgotten_) rows_[forgotten_] = std::vector<SpreadLight>();
  const int walked = walked_;
  walked_ = std::min(end + room_, height_);
  parallel_rows(walked_ - walked, [&](int row) { walk_row(walked + row); });
  if (sharing_.is_exact) {
    const int known = std::min(end + 1, height_);  // the row below the last one lends its light, too
    parallel_rows(known - begin, [&](int row) {
      for (const Look look : {straight, mirrored}) share_row(look, begin + row);
    });
    parallel_rows(end - begin, [&](int row) {
      for (const Look look : {straight, mirrored}) fill_row(look, begin + row);
    });
  }
  tie_knots(begin, end);
}

void SharedWalks::tie_knots(int begin, int end) {
  first_knot_row_ = begin / sharing_.knot_distance;
  const int rows = (end - 1) / sharing_.knot_distance + 2 - first_knot_row_;
  knots_ = Image<std::optional<SpreadDots>>((width_ - 1) / sharing_.knot_distance + 2, rows);
  parallel_rows(rows, [&](int row) {
    for (int column = 0; column < knots_.width(); ++column)
      knots_(column, row) = knot(sharing_.knot_distance * column, sharing_.knot_distance * (first_knot_row_ + row));
  });
}

std::optional<SpreadDots> SharedWalks::knot(int x, int y) const {
  if (x >= width_ || y >= height_) return std::nullopt;
  const Entry& own = entry(straight, x, y);
  if (own.object == kNothing || !own.entered) return std::nullopt;
  std::vector<SpreadLight> lights;
  int count = 0;
  for_each_pair(straight, x, y, own, 0, 1, [&](const Entry& entry, int row) {
    lights.insert(lights.end(), rows_[row].begin() + entry.first, rows_[row].begin() + entry.last);
    ++count;
  });
  if (count == 0) return std::nullopt;
  for (SpreadLight& light : lights) light.dn /= static_cast<float>(count);
  Eigen::AlignedBox2d ways;
  const int reach = (sharing_.is_exact ? 1 : 2) * sharing_.knot_distance;
  for (int down = -reach; down <= reach; down += sharing_.stride)
    for (int across = -reach; across <= reach; across += sharing_.stride)
      if (const Entry* near = alike(straight, x + across, y + down, own))
        if (const auto way = straight_way(near->point.cast<double>())) ways.extend(*way);
  // Samples lie between the pixels that walk; far outside of the grid all is dark.
  const double px = 1.0 / rig_.sensor.ir_scale(), aside_steps = sharing_.stride * px / rig_.sensor.pattern.step_px;
  const Eigen::Vector2d room = Eigen::Vector2d::Constant(aside_steps);
  const Eigen::Vector2d grid(pattern_.sharp().columns(), pattern_.sharp().rows());
  const Eigen::AlignedBox2d shown =
      Eigen::AlignedBox2d(ways.min() - room, ways.max() + room).intersection(Eigen::AlignedBox2d(-grid, 2.0 * grid));
  if (shown.isEmpty()) return std::nullopt;
  return SpreadDots(pattern_, lights, shown.min(), shown.max());
}

std::optional<double> SharedWalks::between_knots(int x, int y, const Entry& to, const Eigen::Vector2d& way) const {
  const int apart = sharing_.knot_distance, column = x / apart, row = y / apart;
  const double across = static_cast<double>(x % apart) / apart, down = static_cast<double>(y % apart) / apart;
  double sum = 0.0, weights = 0.0;
  const auto add = [&](int i, int j, double weight) {
    if (weight == 0.0) return true;
    const int x_knot = column + i, y_knot = row + j - first_knot_row_;
    if (x_knot < 0 || y_knot < 0 || x_knot >= knots_.width() || y_knot >= knots_.height()) return false;
    const std::optional<SpreadDots>& dots = knots_(x_knot, y_knot);
    if (!dots || !alike(straight, apart * (column + i), apart * (row + j), to)) return false;
    sum += weight * (*dots)(way), weights += weight;
    return true;
  };
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      if (!add(i, j, (i == 0 ? 1.0 - across : across) * (j == 0 ? 1.0 - down : down)) && sharing_.is_exact)
        return std::nullopt;
  if (weights == 0.0)  // beside an edge, only where that is enough
    for (int j = -1; j < 3; ++j)
      for (int i = -1; i < 3; ++i) add(i, j, 1.0);
  if (weights == 0.0) return std::nullopt;
  return sum / weights;
}

void SharedWalks::share_row(Look look, int y) {
  if (!holds_any(look, y)) return;
  for (int x = 0; y % 2 == 0 && x < width_; x += 2)
    if (Entry& own = entry(look, x, y); own.object != kNothing && !own.entered) own.shared = walked_around(look, x, y);
}

void SharedWalks::fill_row(Look look, int y) {
  if (!holds_any(look, y)) return;
  for (int x = y % 2 == 0; x < width_; x += y % 2 == 0 ? 2 : 1) {
    Entry& own = entry(look, x, y);
    if (own.object == kNothing || own.entered) continue;
    float sum = 0.0f;
    int count = 0;
    const auto add = [&](int across, int down) {
      const Entry *one = alike(look, x + across, y + down, own), *other = alike(look, x - across, y - down, own);
      if (!one || !other || one->shared == kUnknown || other->shared == kUnknown) return;
      sum += one->shared + other->shared, count += 2;
    };
    add(x % 2, y % 2);
    if (x % 2 == 1 && y % 2 == 1) add(1, -1);
    own.shared = count > 0 ? sum / static_cast<float>(count) : walked_around(look, x, y);
  }
}

float SharedWalks::walked_around(Look look, int x, int y) const {
  const auto mean = mean_around(look, x, y, entry(look, x, y), parity_of(x, y), 4,
                                [](const Entry& entry, int) { return entry.walked; });
  return mean ? static_cast<float>(*mean) : kUnknown;
}

void SharedWalks::walk_row(int y) {
  rows_[y].clear();
  for (const Look look : {straight, mirrored})
    if (std::exchange(holds_any(look, y), false)) std::fill_n(&entry(look, 0, y), width_, Entry());
  if (y % sharing_.stride != 0) return;
  const double px_per_ir_px = 1.0 / rig_.sensor.ir_scale();
  const int stride = sharing_.stride;
  for (int left = 0; left < width_; left += static_cast<int>(kPacket) * stride) {
    const int count = std::min<int>(kPacket, (width_ - left - 1) / stride + 1);
    std::array<Ray, kPacket> rays;
    for (int i = 0; i < count; ++i)
      rays[i] = {rig_.camera_in_world(),
                 rig_.direction_in_world((left + stride * i + 0.5) * px_per_ir_px,
                                         (y - rig_.sensor.ir_first_row() + 0.5) * px_per_ir_px)};
    const Packet<SeenPoint> seen = see(projector_.world(), std::span(rays.data(), count));
    for (int i = 0; i < count; ++i) {
      const SeenPoint* at = seen.find(i);
      const int x = left + stride * i;
      if (at && (sharing_.is_exact || at->entered)) walk(straight, x, y, *at);
      if (!sharing_.is_exact || (at && !at->refracted && !at->entered)) continue;
      Rng rng(seed_, kMirrorStream, y, x);
      bool is_first = true;
      see_mirrored(projector_.world(), rays[i], rng, [&](const SeenPoint& image) {
        if (std::exchange(is_first, false) && !image.entered) walk(mirrored, x, y, image);
      });
    }
  }
}

void SharedWalks::walk(Look look, int x, int y, const SeenPoint& seen) {
  const std::optional<Eigen::Vector2d> way = straight_way(seen.point);
  const double gain = gain_of(seen);
  if (!way || gain <= 0.0 || seen.glaze || (seen.entered ? is_thin(seen) : has_glaze_)) return;
  Entry& own = entry(look, x, y) = entry_of(seen);
  holds_any(look, y) = true;
  if (!seen.entered && parity_of(x, y) != 0) return;
  Rng shifts(seed_, kShiftStream + look), rng(seed_, kSharedWalkStream + look, y, x);
  const FirstStep shift{shifts.uniform(), shifts.uniform(), shifts.uniform()};
  // Those of a square of pixels begin with numbers in a row.
  const int stride = seen.entered ? sharing_.stride : 2, aside = seen.entered ? sharing_.aside : kAsideOnSurface;
  const int place = x / stride + (2 * aside / stride + 1) * (y / stride);
  const int walks = seen.entered ? walks_into(seen.entered->medium, dots_apart(seen)) : 1;
  // A walk from a faint image would end at once: what it is in proportion to is left out.
  SeenPoint bright = seen;
  if (!seen.entered) bright.transmittance = 1.0;
  const double of_bright = gain_of(bright);
  std::vector<SpreadLight>& row = rows_[y];
  own.first = static_cast<std::uint32_t>(row.size());
  double sum = 0.0;
  for (int walk = 0; walk < walks; ++walk) {
    const FirstStep first = even_step(place * walks + walk, shift);
    walk_light(
        projector_, bright, rng,
        [&](const ReturnedLight& light) {
          const std::optional<Eigen::Vector2d> on = on_grid(pattern_.sharp(), rig_, light.direction);
          if (!on) return;
          const double dn = radiance_dn(rig_.sensor, light.reflected) / (walks * of_bright),
                       blur = blur_steps(rig_, light);
          if (seen.entered)
            row.push_back({static_cast<float>(on->x() - way->x()), static_cast<float>(on->y() - way->y()),
                           static_cast<float>(dn), static_cast<float>(blur)});
          else
            sum += dn * pattern_.intensity(*on, blur);
        },
        &first, near_start(seen));
  }
  own.last = static_cast<std::uint32_t>(row.size());
  own.walked = static_cast<float>(sum);
}

double SharedWalks::dots_apart(const SeenPoint& seen) const {
  return rig_.sensor.pattern.step_px / rig_.sensor.focal_px * (seen.point - projector_.position()).norm();
}

SharedWalks::Entry SharedWalks::entry_of(const SeenPoint& seen) const {
  Entry entry;
  entry.object = seen.object, entry.entered = seen.entered, entry.around = seen.around;
  entry.point = seen.point.cast<float>(), entry.normal = seen.normal.cast<float>();
  entry.is_lit = seen.entered && !projector_.world().occluded(seen.point, projector_.position());
  return entry;
}

/// Whether light goes straight through to what lies behind, and back.
bool SharedWalks::is_thin(const SeenPoint& seen) const {
  constexpr double kThick = 7.0;  // of free paths: a thousandth goes on
  const Body& body = *seen.entered;
  const std::optional<Eigen::Vector3d> inside =
      refract(seen.arriving, seen.normal, index_of(seen.around), body.medium.n);
  if (!inside) return true;
  const WorldSpace space(projector_.world());
  const double deep =
      space.next_boundary({seen.point, *inside, 1.0, seen.beyond}, std::numeric_limits<double>::infinity()).distance;
  return deep * body.medium.extinction() < kThick;
}

std::optional<Eigen::Vector2d> SharedWalks::straight_way(const Eigen::Vector3d& point) const {
  return on_grid(pattern_.sharp(), rig_, (point - projector_.position()).normalized());
}

const SharedWalks::Entry* SharedWalks::alike(Look look, int x, int y, const Entry& to) const {
  constexpr float kSameNormal = 0.99f;  // 8 degrees
  constexpr float kSamePlane = 0.15f;   // of the distance
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return nullptr;
  const Entry& entry = this->entry(look, x, y);
  if (entry.object != to.object || entry.entered != to.entered || entry.around != to.around ||
      entry.is_lit != to.is_lit || entry.normal.dot(to.normal) < kSameNormal)
    return nullptr;
  const Eigen::Vector3f apart = entry.point - to.point;
  // Neighbouring pixels of a curved mirror see places far from one another.
  const float farthest_m = 2.0f * sharing_.farthest_m;
  if (look == mirrored && apart.squaredNorm() > farthest_m * farthest_m) return nullptr;
  const float off = apart.dot(to.normal);
  return off * off <= kSamePlane * kSamePlane * apart.squaredNorm() ? &entry : nullptr;
}

double SharedWalks::from_body(const Entry& entry, int y, const Eigen::Vector2d& way) const {
  double sum = 0.0;
  const std::vector<SpreadLight>& row = rows_[y];
  for (std::uint32_t i = entry.first; i < entry.last; ++i) {
    const SpreadLight& light = row[i];
    sum += light.dn * pattern_.intensity(way + Eigen::Vector2d(light.dx_steps, light.dy_steps), light.blur_steps);
  }
  return sum;
}

template <class Visit>
void SharedWalks::for_each_pair(Look look, int x, int y, const Entry& to, int part, int parts, Visit visit) const {
  const int stride = to.entered ? sharing_.stride : 1, aside = aside_of(to) / stride * stride;
  for (int down = 0; down <= aside; down += stride)  // half of the square, each place with the one opposite it
    for (int across = -aside; across <= aside; across += stride) {
      if ((down == 0 && across < 0) || parity_of(across, down) % parts != part) continue;
      const Entry *one = alike(look, x + across, y + down, to), *other = alike(look, x - across, y - down, to);
      if (sharing_.is_exact && (!one || !other)) continue;
      if (one) visit(*one, y + down);
      if (other) visit(*other, y - down);
    }
}

template <class Value>
std::optional<double> SharedWalks::mean_around(Look look, int x, int y, const Entry& to, int part, int parts,
                                               Value value) const {
  double sum = 0.0;
  int count = 0;
  for_each_pair(look, x, y, to, part, parts, [&](const Entry& entry, int row) { sum += value(entry, row), ++count; });
  if (count == 0) return std::nullopt;
  return sum / count;
}

int SharedWalks::aside_of(const Entry& entry) const {
  const double pixel_m =
      (entry.point.cast<double>() - rig_.camera_in_world()).norm() / rig_.sensor.focal_px / rig_.sensor.ir_scale();
  return std::clamp(static_cast<int>(sharing_.farthest_m / pixel_m), 1,
                    entry.entered ? sharing_.aside : kAsideOnSurface);
}

std::optional<double> SharedWalks::radiance(Look look, int x, int y, int sample, int samples,
                                            const SeenPoint& seen) const {
  if (seen.entered ? is_thin(seen) : has_glaze_) return std::nullopt;
  const Entry to = entry_of(seen);
  std::optional<double> mean = mean_at(look, x, y, sample, samples, to);
  // At an edge a pixel's middle may see another surface than its sample, or stand alone: a neighbour's light is
  // nearest.
  for (int down = -1; down <= 1 && !mean; ++down)
    for (int across = -1; across <= 1 && !mean; ++across)
      if ((across != 0 || down != 0) && alike(look, x + across, y + down, to))
        mean = mean_at(look, x + across, y + down, sample, samples, to);
  return mean ? std::optional(*mean * gain_of(seen)) : std::nullopt;
}

std::optional<double> SharedWalks::mean_at(Look look, int x, int y, int sample, int samples, const Entry& to) const {
  if (!to.entered) {
    const Entry* own = alike(look, x, y, to);
    return own && own->shared != kUnknown ? std::optional<double>(own->shared) : std::nullopt;
  }
  const std::optional<Eigen::Vector2d> way = straight_way(to.point.cast<double>());
  if (!way) return std::nullopt;
  if (const auto mean = between_knots(x, y, to, *way)) return mean;
  if (!sharing_.is_exact) return std::nullopt;
  const int parts = std::min(samples, 4);
  return mean_around(look, x, y, to, sample % parts, parts,
                     [&](const Entry& entry, int row) { return from_body(entry, row, *way); });
}

}  // namespace fathom
