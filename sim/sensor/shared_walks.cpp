#include "sim/sensor/shared_walks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <variant>

#include "core/parallel.h"
#include "sim/render/light_walk.h"
#include "sim/render/radiance.h"
#include "sim/render/world_space.h"

namespace fathom {
namespace {

constexpr std::uint64_t kSharedWalkStream = 0x736861726564ULL;
constexpr std::uint64_t kShiftStream = 0x7368696674ULL;

// Pixels to each side that share, but no farther than kFarthest_m. More of them take out more chance; but the light of
// places farther apart is less alike.
constexpr int kAsideInBody = 9, kAsideOnSurface = 5;
constexpr double kFarthest_m = 0.0055;

int parity_of(int x, int y) { return (x & 1) + 2 * (y & 1); }

/// Grid steps from where light enters a body, beyond which what returns shows dots too wide to be told apart.
constexpr double kNear = 1.5;

/// The farther apart light enters and leaves, the less of it still shows dots, and the more walks bring out as much.
int walks_into(const Turbid& medium, double dots_apart) {
  constexpr double kOfEachStep = 2.0;
  constexpr int kLeast = 2, kMost = 8;
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

SharedWalks::SharedWalks(const PointLight& projector, const Rig& rig, const BlurredPattern& pattern, std::uint64_t seed)
    : projector_(projector),
      rig_(rig),
      pattern_(pattern),
      seed_(seed),
      has_glaze_(has_glaze(projector.world().geometry())),
      entries_(rig.sensor.ir_width, rig.sensor.ir_height),
      rows_(rig.sensor.ir_height) {}

void SharedWalks::prepare(int begin, int end) {
  for (; forgotten_ < begin - kAsideInBody; ++forgotten_) rows_[forgotten_] = std::vector<Returned>();
  const int walked = walked_;
  walked_ = std::min(end + kAsideInBody, entries_.height());
  parallel_ranges(walked_ - walked, [&](int first, int last) {
    for (int y = walked + first; y < walked + last; ++y) walk_row(y);
  });
  parallel_ranges(end - begin, [&](int first, int last) {
    for (int y = begin + first; y < begin + last; ++y) share_row(y);
  });
}

void SharedWalks::share_row(int y) {
  const auto walked = [](const Entry& entry, int) { return entry.walked; };
  for (int x = 0; x < entries_.width(); ++x)
    if (Entry& entry = entries_(x, y); entry.object != kNothing && !entry.entered)
      if (const auto mean = mean_around(x, y, entry, parity_of(x, y), 4, walked))
        entry.shared = static_cast<float>(*mean);
}

void SharedWalks::walk_row(int y) {
  const double px_per_ir_px = 1.0 / rig_.sensor.ir_scale();
  for (int left = 0; left < entries_.width(); left += kPacket) {
    const int count = std::min<int>(kPacket, entries_.width() - left);
    std::array<Ray, kPacket> rays;
    for (int i = 0; i < count; ++i)
      rays[i] = {rig_.camera_in_world(),
                 rig_.direction_in_world((left + i + 0.5) * px_per_ir_px,
                                         (y - rig_.sensor.ir_first_row() + 0.5) * px_per_ir_px)};
    const Packet<SeenPoint> seen = see(projector_.world(), std::span(rays.data(), count));
    for (int i = 0; i < count; ++i)
      if (const SeenPoint* at = seen.find(i)) walk(left + i, y, *at);
  }
}

void SharedWalks::walk(int x, int y, const SeenPoint& seen) {
  const std::optional<Eigen::Vector2d> way = straight_way(seen.point);
  const double gain = gain_of(seen);
  if (!way || gain <= 0.0 || seen.glaze || (seen.entered ? is_thin(seen) : has_glaze_)) return;
  Entry& entry = entries_(x, y) = entry_of(seen);
  if (!seen.entered && parity_of(x, y) != 0) return;
  Rng shifts(seed_, kShiftStream), rng(seed_, kSharedWalkStream, y, x);
  const FirstStep shift{shifts.uniform(), shifts.uniform(), shifts.uniform()};
  // Those of a square of pixels begin with numbers in a row.
  const int place = seen.entered ? x + (2 * kAsideInBody + 1) * y : x / 2 + (kAsideOnSurface + 1) * (y / 2);
  const double dots_apart =
      rig_.sensor.pattern.step_px / rig_.sensor.focal_px * (seen.point - projector_.position()).norm();
  const int walks = seen.entered ? walks_into(seen.entered->medium, dots_apart) : 1;
  std::vector<Returned>& row = rows_[y];
  entry.first = static_cast<std::uint32_t>(row.size());
  double sum = 0.0;
  for (int walk = 0; walk < walks; ++walk) {
    const FirstStep first = even_step(place * walks + walk, shift);
    walk_light(
        projector_, seen, rng,
        [&](const ReturnedLight& light) {
          const std::optional<Eigen::Vector2d> on = on_grid(pattern_.sharp(), rig_, light.direction);
          if (!on) return;
          const double dn = radiance_dn(rig_.sensor, light.reflected) / (walks * gain), blur = blur_steps(rig_, light);
          if (seen.entered)
            row.push_back({static_cast<float>(on->x() - way->x()), static_cast<float>(on->y() - way->y()),
                           static_cast<float>(dn), static_cast<float>(blur)});
          else
            sum += dn * pattern_.intensity(*on, blur);
        },
        &first, kNear * dots_apart);
  }
  entry.last = static_cast<std::uint32_t>(row.size());
  entry.walked = static_cast<float>(sum);
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

const SharedWalks::Entry* SharedWalks::alike(int x, int y, const Entry& to) const {
  constexpr float kSameNormal = 0.99f;  // 8 degrees
  constexpr float kSamePlane = 0.15f;   // of the distance
  if (x < 0 || y < 0 || x >= entries_.width() || y >= entries_.height()) return nullptr;
  const Entry& entry = entries_(x, y);
  if (entry.object != to.object || entry.entered != to.entered || entry.around != to.around ||
      entry.is_lit != to.is_lit || entry.normal.dot(to.normal) < kSameNormal)
    return nullptr;
  const Eigen::Vector3f apart = entry.point - to.point;
  const float off = apart.dot(to.normal);
  return off * off <= kSamePlane * kSamePlane * apart.squaredNorm() ? &entry : nullptr;
}

double SharedWalks::from_body(const Entry& entry, int y, const Eigen::Vector2d& way) const {
  double sum = 0.0;
  const std::vector<Returned>& row = rows_[y];
  for (std::uint32_t i = entry.first; i < entry.last; ++i) {
    const Returned& light = row[i];
    sum += light.dn * pattern_.intensity(way + Eigen::Vector2d(light.dx_steps, light.dy_steps), light.blur_steps);
  }
  return sum;
}

template <class Value>
std::optional<double> SharedWalks::mean_around(int x, int y, const Entry& to, int part, int parts, Value value) const {
  double sum = 0.0;
  int count = 0;
  const int aside = aside_of(to);
  for (int down = 0; down <= aside; ++down)  // half of the square, each place with the one opposite it
    for (int across = -aside; across <= aside; ++across) {
      if ((down == 0 && across < 0) || parity_of(across, down) % parts != part) continue;
      const Entry *one = alike(x + across, y + down, to), *other = alike(x - across, y - down, to);
      if (!one || !other) continue;
      sum += value(*one, y + down) + value(*other, y - down);
      count += 2;
    }
  if (count == 0) return std::nullopt;
  return sum / count;
}

int SharedWalks::aside_of(const Entry& entry) const {
  const double pixel_m =
      (entry.point.cast<double>() - rig_.camera_in_world()).norm() / rig_.sensor.focal_px / rig_.sensor.ir_scale();
  return std::clamp(static_cast<int>(kFarthest_m / pixel_m), 1, entry.entered ? kAsideInBody : kAsideOnSurface);
}

std::optional<double> SharedWalks::radiance(int x, int y, int sample, int samples, const SeenPoint& seen) const {
  if (entries_(x, y).object == kNothing) return std::nullopt;
  const Entry to = entry_of(seen);
  std::optional<double> mean;
  if (!seen.entered) {
    if (const Entry* own = alike(x, y, to); own && own->shared != kUnknown) mean = own->shared;
  } else if (const std::optional<Eigen::Vector2d> way = straight_way(seen.point)) {
    const int parts = std::min(samples, 4);
    mean = mean_around(x, y, to, sample % parts, parts,
                       [&](const Entry& entry, int row) { return from_body(entry, row, *way); });
  }
  return mean ? std::optional(*mean * gain_of(seen)) : std::nullopt;
}

}  // namespace fathom
