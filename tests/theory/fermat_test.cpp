// The exact triangulation against a calculation that shares nothing with it: paths by Fermat's principle instead of
// Snell's law, the measured point by cutting the camera's ray with the projector's column plane instead of disparity.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "theory/triangulation.h"

namespace fathom::theory {
namespace {

using Vector3l = Eigen::Matrix<long double, 3, 1>;

/// The place of the minimum of a unimodal function on [low, high], by golden sections.
template <class F>
long double minimum_place(F&& f, long double low, long double high) {
  const long double golden = (std::sqrt(5.0L) - 1.0L) / 2.0L;
  long double left = high - golden * (high - low), right = low + golden * (high - low);
  long double at_left = f(left), at_right = f(right);
  for (int i = 0; i < 90; ++i) {  // 0.618^90 = 1e-19, long double's precision
    if (at_left < at_right) {
      high = right;
      right = left, at_right = at_left;
      at_left = f(left = high - golden * (high - low));
    } else {
      low = left;
      left = right, at_left = at_right;
      at_right = f(right = low + golden * (high - low));
    }
  }
  return (low + high) / 2.0L;
}

/// The surface point of the path of least time from `source` to `bottom`, searched over the surface in x and y. The
/// optical length is convex in both, so nested line searches find its one minimum.
Vector3l surface_point(const Vector3l& source, const Vector3l& bottom, long double w, long double n) {
  const auto length = [&](long double x, long double y) {
    const Vector3l at(x, y, w);
    return (at - source).norm() + n * (bottom - at).norm();
  };
  const auto best_y = [&](long double x) {
    return minimum_place([&](long double y) { return length(x, y); }, source.y() - 0.1L, bottom.y() + 0.1L);
  };
  const auto [low, high] = std::minmax(source.x(), bottom.x());
  const long double x =
      minimum_place([&](long double at_x) { return length(at_x, best_y(at_x)); }, low - 0.1L, high + 0.1L);
  return {x, best_y(x), w};
}

TEST(Fermat, PathsOfLeastTimeGiveTheSameMeasuredPoint) {
  std::mt19937 random(20);
  const auto between = [&random](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int trial = 0; trial < 20; ++trial) {
    const TriangulationSetup setup{.sensor_height = between(0.4, 0.9),
                                   .baseline = between(0.05, 0.15),
                                   .fill = between(0.005, 0.1),
                                   .index = between(1.2, 1.6),
                                   .lateral = between(-0.3, 0.3),
                                   .distance = between(0.1, 0.7),
                                   .pitch = between(0.7, 1.4)};
    const long double b = setup.baseline;
    const Vector3l camera(-b / 2, 0, setup.sensor_height), projector(b / 2, 0, setup.sensor_height);
    const Vector3l bottom(setup.lateral, setup.distance, 0);
    const Vector3l received = surface_point(camera, bottom, setup.fill, setup.index) - camera;
    const Vector3l projected = surface_point(projector, bottom, setup.fill, setup.index) - projector;

    const Vector3l image_down(0, -std::sin(*setup.pitch), -std::cos(*setup.pitch));
    const Vector3l column_normal = projected.cross(image_down);
    const Vector3l measured =
        camera + received * ((projector - camera).dot(column_normal) / received.dot(column_normal));

    const Triangulation result = triangulate(setup);
    // A minimum of long doubles is flat over √1e-19 = 3e-10 of the range; Z / b ≈ 15 of that is 5 nm. 10 of them.
    EXPECT_LT((result.measured - measured.cast<double>()).norm(), 5e-8) << "trial " << trial;
    const auto incidence = [](const Vector3l& ray) {
      return static_cast<double>(std::atan2(ray.head<2>().norm(), -ray.z()));
    };
    EXPECT_NEAR(result.incidence_camera, incidence(received), 1e-8);
    EXPECT_NEAR(result.incidence_projector, incidence(projected), 1e-8);
  }
}

}  // namespace
}  // namespace fathom::theory
