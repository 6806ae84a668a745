#include "tests/soak/light_laws.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/render/crossing.h"

namespace fathom {
namespace {

constexpr double kStep = 1e-6;  // [rad]
/// By which share of its width a tube may bend. Edges bend it by about its width, smooth surfaces far less.
constexpr double kBend = 1e-2;
/// [m] a hundred times what shoot() calls a hit: near caustics rounding grows.
constexpr double kMiss = 1e-8;
/// Of the product of a tube's widths. Central differences err by about the square of kBend.
constexpr double kArea = 1e-3;
/// Of a tube's width over its angle: farther behind, as on the handle's or the wall's far side, a ray makes the tube
/// wider by as much.
constexpr double kStepInDepth = 0.1 * kArea;

/// Where five neighbouring rays land, as seen along the middle one: [m] from where that lands, perpendicular to its
/// direction there.
struct Tube {
  Eigen::Vector3d landing;    ///< of the middle ray
  Eigen::Matrix2d per_angle;  ///< [m/rad] from one side to the other, over the angle between them
  Eigen::Matrix2d bend;       ///< [m] by which the middle ray lands off the others' middle
  Eigen::Vector2d step;       ///< [m] the same along its direction
};

class Tubes {
 public:
  explicit Tubes(const PointLight& projector)
      : projector_(projector), inside_(projector.world().bodies_around(projector.position())) {}

  /// Nothing where the five do not land on the same object in the same medium.
  std::optional<Tube> sent(const Eigen::Vector3d& direction, const Eigen::Vector3d& arrival) const {
    const std::optional<SeenPoint> middle = land(direction);
    if (!middle) return std::nullopt;
    const Matrix32d angles = perpendicular_to(direction), plane = perpendicular_to(arrival);
    Tube tube{middle->point, {}, {}, {}};
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector3d aside = kStep * angles.col(axis);
      const auto low = land(direction - aside), high = land(direction + aside);
      for (const auto& side : {low, high})
        if (!side || side->object != middle->object || side->around != middle->around) return std::nullopt;
      tube.per_angle.col(axis) = plane.transpose() * (high->point - low->point) / (2.0 * kStep);
      const Eigen::Vector3d off_middle = 0.5 * (high->point + low->point) - middle->point;
      tube.bend.col(axis) = plane.transpose() * off_middle;
      tube.step[axis] = arrival.dot(off_middle);
    }
    return tube;
  }

 private:
  std::optional<SeenPoint> land(const Eigen::Vector3d& direction) const {
    return see(projector_.world(), {projector_.position(), direction.normalized()}, inside_);
  }

  const PointLight& projector_;
  BodySet inside_;
};

/// What one point of the scene has to say.
class PointLaws {
 public:
  PointLaws(const PointLight& projector, const Tubes& tubes, const SeenPoint& seen, TubeCounts& counts)
      : tubes_(tubes), seen_(seen), counts_(counts) {
    projector.connect({seen.point, seen.around, &seen.normal}, [&](const Connection& way) {
      if (takes_up(seen, way.arrival) && !way.through_scattering) ways_.push_back(way);
    });
  }

  /// The first law that is broken.
  std::optional<std::string> broken() {
    const double n = index_of(seen_.around);
    if (!is_share(seen_.transmittance * n * n))
      return fmt::format("the camera's ray passes on {}", seen_.transmittance * n * n);
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      if (const auto breach = broken_by(ways_[i])) return breach;
      for (std::size_t j = 0; j < i; ++j)
        if ((ways_[i].direction - ways_[j].direction).norm() < kStep && ways_[i].turned_over == ways_[j].turned_over)
          return fmt::format("one way is found twice, {} rad apart", (ways_[i].direction - ways_[j].direction).norm());
    }
    return std::nullopt;
  }

 private:
  /// From 0 to 1, up to the rounding of some products.
  static bool is_share(double value) { return value >= 0.0 && value <= 1.0 + 1e-12; }

  std::optional<std::string> broken_by(const Connection& way) {
    if (!is_share(way.transmittance)) return fmt::format("a way passes on {}", way.transmittance);
    if (!(way.spreading > 0.0) || !std::isfinite(way.spreading))
      return fmt::format("a way spreads by {}", way.spreading);
    const auto tube = tubes_.sent(way.direction, way.arrival);
    // Beyond a smooth surface's edge rays land elsewhere, or bend by another law.
    const bool whole = tube && tube->bend.norm() <= kBend * kStep * tube->per_angle.norm() &&
                       tube->step.norm() <= kStepInDepth * tube->per_angle.norm();
    if (!whole) {
      ++counts_.torn;
      return std::nullopt;
    }
    ++counts_.held;
    const Eigen::Vector3d off = tube->landing - seen_.point;
    const double miss = (off - off.dot(way.arrival) * way.arrival).norm();
    if (miss > kMiss) return fmt::format("a way over {} interfaces ends {} m off its point", way.crossings, miss);
    const double area = std::fabs(tube->per_angle.determinant());
    const double scale = tube->per_angle.col(0).norm() * tube->per_angle.col(1).norm();
    if (std::fabs(area - 1.0 / way.spreading) > kArea * scale)
      return fmt::format("a tube over {} interfaces is {} m²/sr wide where its spreading says {}", way.crossings, area,
                         1.0 / way.spreading);
    return std::nullopt;
  }

  const Tubes& tubes_;
  const SeenPoint& seen_;
  TubeCounts& counts_;
  std::vector<Connection> ways_;
};

}  // namespace

std::vector<std::string> broken_light_laws(const PointLight& projector, const Rig& rig, TubeCounts& counts) {
  const Tubes tubes(projector);
  std::vector<std::string> broken;
  for (int y = 0; y < rig.sensor.height; ++y)
    for (int x = 0; x < rig.sensor.width; ++x) {
      const Ray chief{rig.camera_in_world(), rig.direction_in_world(x + 0.5, y + 0.5)};
      const auto seen = see(projector.world(), chief);
      if (!seen) continue;
      if (const auto breach = PointLaws(projector, tubes, *seen, counts).broken())
        broken.push_back(fmt::format("pixel ({}, {}): {}", x, y, *breach));
    }
  return broken;
}

}  // namespace fathom
