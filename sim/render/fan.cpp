#include "sim/render/fan.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace fathom {
namespace {

constexpr double kSpacing = 2e-3;   ///< [rad] 1.3 mm from the sensor's height
constexpr double kBox = 5e-3;       ///< [m] edge of a box; pencils that grow wider than this are sent more finely
constexpr int kMostHalvings = 2;    ///< of the spacing
constexpr double kBeyond = 5e-3;    ///< [m] that a piece counts beyond its ends: rays beside it may be longer
constexpr int kLongestChain = 8;    ///< of interfaces; light that is trapped in a wall goes on for long
constexpr double kFaintest = 1e-4;  ///< transmittance

using GridCell = std::pair<int, int>;

/// A gnomonic grid about an axis, as the source sees it.
struct Grid {
  const Eigen::Vector3d& source;
  const Eigen::Vector3d& axis;
  Matrix32d basis;

  Eigen::Vector3d middle(const GridCell& cell) const {
    return (axis + basis * Eigen::Vector2d(cell.first + 0.5, cell.second + 0.5) * kSpacing).normalized();
  }
  /// In cells; nothing far off the axis.
  std::optional<Eigen::Array2d> place(const Eigen::Vector3d& point) const {
    constexpr double kWidest = 0.1;  // cosine: 84° off the axis
    const Eigen::Vector3d towards = point - source;
    const double along = towards.dot(axis);
    if (along < kWidest * towards.norm()) return std::nullopt;
    return (basis.transpose() * towards / along).array() / kSpacing;
  }
};

/// The cells that contain boundaries of clear bodies, in order.
std::vector<GridCell> covered_cells(const Geometry& geometry, const Grid& grid) {
  std::vector<GridCell> cells;
  std::vector<std::optional<Eigen::Array2d>> places;  // of vertices
  for (const Surface& surface : geometry.surfaces) {
    if (!std::holds_alternative<Interface>(surface.optics)) continue;
    places.clear();
    for (const Eigen::Vector3d& vertex : surface.mesh.vertices) places.push_back(grid.place(vertex));
    for (const Eigen::Vector3i& triangle : surface.mesh.triangles) {
      Eigen::Array2d low = Eigen::Array2d::Constant(1e9), high = -low;
      for (const int corner : triangle)
        if (places[corner]) low = low.min(*places[corner]), high = high.max(*places[corner]);
      for (int i = static_cast<int>(std::floor(low.x())); i <= high.x(); ++i)
        for (int j = static_cast<int>(std::floor(low.y())); j <= high.y(); ++j) cells.emplace_back(i, j);
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

Eigen::Vector3d mean_direction(const Geometry& geometry, const Eigen::Vector3d& source) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Surface& surface : geometry.surfaces)
    if (std::holds_alternative<Interface>(surface.optics))
      for (const Eigen::Vector3d& vertex : surface.mesh.vertices) sum += (vertex - source).normalized();
  return sum.norm() > 0.0 ? Eigen::Vector3d(sum.normalized()) : -Eigen::Vector3d::UnitZ();
}

Seed seed_of(const Flight& flight, const Eigen::Vector3d& direction, double spacing, int crossings, int mirror,
             const Body* medium, double begin, double end) {
  const RayDifferential& at = flight.differential;
  const Matrix32d across = perpendicular_to(at.direction);
  const Eigen::Vector3d squared_width(at.d_origin.squaredNorm(), 2.0 * at.d_origin.cwiseProduct(at.d_direction).sum(),
                                      at.d_direction.squaredNorm());
  return {medium,
          begin,
          end,
          at.origin,
          at.direction,
          spacing * spacing * squared_width,
          across,
          across.transpose() * at.d_origin,
          across.transpose() * at.d_direction,
          spacing,
          direction,
          flight.transmittance,
          crossings,
          mirror};
}

double squared_reach_of(const Seed& seed, double distance) {
  const Eigen::Vector3d& of = seed.squared_reach;
  return std::max(of[0] + distance * (of[1] + distance * of[2]), 0.0);
}

std::uint64_t box_of(const Eigen::Array3i& index) {
  constexpr int kHalf = 1 << 20;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) key = key << 21 | static_cast<std::uint64_t>(index[axis] + kHalf);
  return key;
}

Eigen::Array3i box_index(const Eigen::Vector3d& point) { return (point.array() / kBox).floor().cast<int>(); }

}  // namespace

double Seed::reach(double distance) const { return std::sqrt(squared_reach_of(*this, distance)); }

Eigen::Matrix2d Seed::jacobian_at(double distance) const { return jacobian + distance * jacobian_per_m; }

Fan::Fan(const Intersector& world, const Source& source, Ways ways) : ways_(ways) {
  const Eigen::Vector3d axis = mean_direction(world.geometry(), source.position);
  const Grid grid{source.position, axis, perpendicular_to(axis)};
  for (const GridCell& cell : covered_cells(world.geometry(), grid))
    send(world, source, grid.middle(cell), kSpacing, 0);
  for (std::uint32_t seed = 0; seed < seeds_.size(); ++seed) file(seed);
}

void Fan::send(const Intersector& world, const Source& source, const Eigen::Vector3d& direction, double spacing,
               int halvings) {
  const std::size_t sent = seeds_.size();
  const Flight flight{ray_differential_from(source.position, direction), source.inside, 1.0,
                      Loss::without_peak};  // ways that walks would miss are kept
  const bool too_wide = follow(world, flight, direction, spacing, 0, kNoMirror);
  if (!too_wide || halvings == kMostHalvings) return;
  seeds_.resize(sent);
  const Matrix32d basis = perpendicular_to(direction);
  for (const double a : {-0.25, 0.25})
    for (const double b : {-0.25, 0.25})
      send(world, source, (direction + basis * Eigen::Vector2d(a, b) * spacing).normalized(), 0.5 * spacing,
           halvings + 1);
}

bool Fan::follow(const Intersector& world, Flight flight, const Eigen::Vector3d& direction, double spacing,
                 int crossings, int mirror) {
  bool too_wide = false;
  for (; crossings <= kLongestChain && flight.transmittance > kFaintest; ++crossings) {
    const Ray ray{flight.differential.origin, flight.differential.direction};
    const std::optional<Crossing> next = next_crossing(world, ray, flight.inside);
    const std::optional<Hit> opaque = world.first_opaque(ray);
    const double open = opaque ? opaque->distance : std::numeric_limits<double>::infinity();
    const bool ends = !next || open < next->hit.distance;
    const Body* medium = medium_in(world.geometry(), flight.inside);
    const bool asked_for = ways_ == Ways::refracted ? crossings > 0 : mirror != kNoMirror;
    // In air only surfaces receive light; in a body any place may scatter it.
    if (asked_for && (medium || ends) && (std::isfinite(open) || next)) {
      const double end = ends ? open : next->hit.distance;
      seeds_.push_back(seed_of(flight, direction, spacing, crossings, mirror, medium, medium ? 0.0 : end, end));
      too_wide = too_wide || seeds_.back().reach(end) > kBox;
    }
    if (ends) break;
    if (ways_ == Ways::mirrored && mirror == kNoMirror) {
      Flight mirrored = flight;
      const bool in_part = pass(world, *next, Event::reflect, mirrored) < 1.0;
      if (in_part && follow(world, mirrored, direction, spacing, crossings + 1, crossings)) too_wide = true;
    }
    pass(world, *next, Event::refract, flight);
  }
  return too_wide;
}

void Fan::file(std::uint32_t number) {
  const Seed& seed = seeds_[number];
  const double begin = seed.begin - kBeyond, length = seed.end + kBeyond - begin;
  const int steps = static_cast<int>(std::ceil(length / kBox));
  for (int step = 0; step <= steps; ++step) {
    const double distance = begin + length * step / steps;
    const Eigen::Vector3d middle = seed.origin + distance * seed.heading;
    const double strength = seed.transmittance / std::fabs(seed.jacobian_at(distance).determinant());
    const double around = std::clamp(2.0 * seed.reach(distance), 0.5 * kBox, kBox);
    const Eigen::Array3i low = box_index(middle.array() - around), high = box_index(middle.array() + around);
    for (int i = low.x(); i <= high.x(); ++i)
      for (int j = low.y(); j <= high.y(); ++j)
        for (int k = low.z(); k <= high.z(); ++k) {
          Box& box = boxes_[box_of({i, j, k})];
          if (box.seeds.empty() || box.seeds.back() != number) box.seeds.push_back(number);  // steps share most boxes
          box.strength = std::max(box.strength, strength);
        }
  }
}

std::vector<Fan::Candidate> Fan::near(const Eigen::Vector3d& target, const Body* around) const {
  constexpr double kMostSteps = 2.5;
  std::vector<Candidate> candidates;
  const Box* box = box_around(target);
  if (!box) return candidates;
  for (const std::uint32_t number : box->seeds) {
    const Seed& seed = seeds_[number];
    if (seed.medium != around) continue;
    const Eigen::Vector3d offset = target - seed.origin;
    const double distance = offset.dot(seed.heading);
    if (distance < seed.begin - kBeyond || distance > seed.end + kBeyond) continue;
    const double squared_reach = squared_reach_of(seed, distance);
    if (offset.squaredNorm() - distance * distance > kMostSteps * kMostSteps * squared_reach) continue;
    const Eigen::Vector2d miss = seed.across.transpose() * offset;
    const Eigen::Matrix2d jacobian = seed.jacobian_at(distance);
    const double determinant = jacobian.determinant();
    Eigen::Vector2d step = jacobian.inverse() * miss;
    double steps = step.norm() / seed.spacing;
    // Near a caustic the landing is far from linear: a small miss is as good as a short step.
    const bool by_step = steps < kMostSteps;
    if (!by_step) {
      if (miss.squaredNorm() > 0.7 * 0.7 * squared_reach) continue;
      step.setZero(), steps = kMostSteps;
    }
    candidates.push_back({&seed, steps, miss.norm(), step, by_step, determinant < 0.0});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.steps, a.miss, a.seed) < std::tuple(b.steps, b.miss, b.seed);
  });
  return candidates;
}

double Fan::strength_near(const Eigen::Vector3d& target) const {
  const Box* box = box_around(target);
  return box ? box->strength : 0.0;
}

const Fan::Box* Fan::box_around(const Eigen::Vector3d& point) const {
  const auto box = boxes_.find(box_of(box_index(point)));
  return box == boxes_.end() ? nullptr : &box->second;
}

}  // namespace fathom
