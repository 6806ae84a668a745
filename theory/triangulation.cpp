#include "theory/triangulation.h"

#include <Eigen/Geometry>
#include <cmath>

#include "theory/raised_bottom.h"
#include "theory/require.h"

namespace fathom::theory {
namespace {

/// Tangent of the incidence angle at which light from `above` the surface reaches a bottom point at horizontal distance
/// `rho` through `w` of liquid: the root t of
///   g(t) = above t + w tan θ2 = rho,   tan θ2 = t / √(n² + (n² − 1) t²)   (Snell, sin θ1 = n sin θ2).
/// g rises and is concave, and g <= rho on the straight line, so Newton's steps from there rise to the root.
double incidence_tangent(double above, double w, double n, double rho) {
  double t = rho / (above + w);
  for (;;) {
    const double root = std::sqrt(n * n + (n * n - 1.0) * t * t);
    const double value = above * t + w * t / root;
    const double slope = above + w * n * n / (root * root * root);
    const double next = t + (rho - value) / slope;
    if (!(next > t)) return t;
    t = next;
  }
}

/// Direction in air of the path from `source` to the bottom point, scaled to z = −1.
Eigen::Vector3d air_direction(const Eigen::Vector3d& source, const Eigen::Vector3d& bottom, double w, double n) {
  const Eigen::Vector2d across = (bottom - source).head<2>();
  const double rho = across.norm();
  const double tangent = incidence_tangent(source.z() - w, w, n, rho);
  const Eigen::Vector2d horizontal = rho > 0.0 ? Eigen::Vector2d(across * (tangent / rho)) : Eigen::Vector2d::Zero();
  return {horizontal.x(), horizontal.y(), -1.0};
}

void require_sense(const TriangulationSetup& setup) {
  require(setup.index >= 1.0 && std::isfinite(setup.index), "the liquid's index must be at least 1");
  require(setup.fill >= 0.0, "the liquid's depth must not be negative");
  require(setup.sensor_height > setup.fill && std::isfinite(setup.sensor_height),
          "the sensor must be above the surface");
  require(setup.baseline > 0.0 && std::isfinite(setup.baseline), "the baseline must be positive");
  require(setup.focal_px > 0.0 && std::isfinite(setup.focal_px), "the focal length must be positive");
  require(std::isfinite(setup.lateral) && std::isfinite(setup.distance), "the bottom point must be finite");
  require(!setup.pitch || std::isfinite(*setup.pitch), "the pitch must be finite");
}

}  // namespace

Triangulation triangulate(const TriangulationSetup& setup) {
  require_sense(setup);
  const Eigen::Vector3d camera(-setup.baseline / 2.0, 0.0, setup.sensor_height);
  const Eigen::Vector3d projector(setup.baseline / 2.0, 0.0, setup.sensor_height);
  const Eigen::Vector3d bottom(setup.lateral, setup.distance, 0.0);
  const Eigen::Vector3d received = air_direction(camera, bottom, setup.fill, setup.index);
  const Eigen::Vector3d projected = air_direction(projector, bottom, setup.fill, setup.index);

  const double pitch = setup.pitch.value_or(std::atan2(setup.sensor_height, setup.distance));
  const Eigen::Vector3d forward(0.0, std::cos(pitch), -std::sin(pitch));
  const Eigen::Vector3d down = forward.cross(Eigen::Vector3d::UnitX());
  const double received_z = received.dot(forward);
  const double projected_z = projected.dot(forward);
  require(received_z > 0.0 && projected_z > 0.0, "the bottom point must be in front of the sensor");

  const double disparity = received.x() / received_z - projected.x() / projected_z;
  const double mismatch = received.dot(down) / received_z - projected.dot(down) / projected_z;
  const Eigen::Vector3d measured = camera + received * (setup.baseline / disparity / received_z);
  return {.height = measured.z(),
          .measured = measured,
          .incidence_projector = std::atan(projected.head<2>().norm()),
          .incidence_camera = std::atan(received.head<2>().norm()),
          .disparity_px = setup.focal_px * disparity,
          .epipolar_mismatch_px = setup.focal_px * mismatch};
}

RaisedBottom raised_bottom(const TriangulationSetup& setup) {
  const BottomView view{.h = setup.sensor_height, .b = setup.baseline, .d = setup.distance, .n = setup.index};
  return {.eq7 = raised_height_at(setup.fill, view), .exact = triangulate(setup)};
}

std::optional<double> fill_from_height(double height, TriangulationSetup setup, double max_fill) {
  require(max_fill > 0.0 && max_fill < setup.sensor_height,
          "the largest fill must be between 0 and the sensor's height");
  const auto height_at = [&setup](double fill) {
    setup.fill = fill;
    return triangulate(setup).height;
  };
  const double highest = height_at(max_fill);
  if (!(height > 0.0 && height <= highest) || setup.index == 1.0) return std::nullopt;
  // The height rises with the fill; bisect until the two ends are neighbours.
  double low = 0.0, high = max_fill;
  for (;;) {
    const double middle = low + (high - low) / 2.0;
    if (!(middle > low && middle < high)) return high;
    (height_at(middle) < height ? low : high) = middle;
  }
}

}  // namespace fathom::theory
