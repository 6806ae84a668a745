#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "bench/accuracy.h"
#include "bench/sensor_scenes.h"
#include "core/units.h"
#include "tests/core/temporary_folder.h"
#include "tests/scene/write_gltf.h"

namespace fathom {
namespace {

/// A box, its lowest face at z = 0.
Mesh box(double width, double depth, double height) {
  Mesh mesh;
  for (const double z : {0.0, height})
    for (const double y : {-0.5 * depth, 0.5 * depth})
      for (const double x : {-0.5 * width, 0.5 * width}) mesh.add_vertex({x, y, z});
  constexpr std::array<std::array<int, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kSides) mesh.add_triangle(a, b, c), mesh.add_triangle(a, c, d);
  return mesh;
}

struct EdgeFigures {
  double shadow_px;  ///< mean over rows
  double sigma_px;   ///< of the right edge about its line
};

EdgeFigures edges_of(const Image<float>& depth, double nearer_than, int first_row, int last_row) {
  double shadow = 0.0;
  std::vector<double> edge;
  for (int y = first_row; y < last_row; ++y) {
    int left = 0, right = depth.width() - 1;
    const auto near = [&](int x) { return depth(x, y) > 0.0f && depth(x, y) < nearer_than; };
    while (left < right && !near(left)) ++left;
    while (right > left && !near(right)) --right;
    int gap = 0;
    while (left - gap > 0 && depth(left - gap - 1, y) == 0.0f) ++gap;
    shadow += gap;
    edge.push_back(right);
  }
  const Eigen::Map<const Eigen::ArrayXd> x(edge.data(), static_cast<Eigen::Index>(edge.size()));
  const double n = static_cast<double>(edge.size()), half = 0.5 * (n - 1.0);
  const Eigen::ArrayXd row = Eigen::ArrayXd::LinSpaced(x.size(), -half, half);
  const double slope = (row * x).sum() / row.square().sum();
  const double variance = (x - x.mean() - slope * row).square().sum() / (n - 2.0);
  return {shadow / n, std::sqrt(variance)};
}

}  // namespace

void compare_edges(CaptureMode mode) {
  print_title("A box before a wall: the projector's shadow to its left, its right edge");
  const TemporaryFolder folder;
  for (const auto& [near, far] : {std::pair{0.6, 0.7}, std::pair{0.5, 0.6}}) {
    const std::filesystem::path file = folder / "box.gltf";
    write_gltf(file, box(0.15, 0.15, far - near));
    const Setup setup = wall_with(far, file.string(), 0.0);
    const Frame frame = shoot(setup, 1, mode);
    const EdgeFigures figures = edges_of(frame.depth, 0.5 * (near + far), 190, 290);
    const SensorModel& sensor = setup.rig.sensor;
    const double expected = sensor.focal_px * sensor.baseline * (1.0 / near - 1.0 / far);
    print_figure(fmt::format("{:.0f} before {:.0f} mm: shadow [px]", mm_from_metres(near), mm_from_metres(far)),
                 figures.shadow_px, expected, "f b (1/z - 1/z')", within(expected, 1.0));
    print_figure("         lateral sigma of the edge [px]", figures.sigma_px, 0.8, "Nguyen et al.");
  }
}

}  // namespace fathom
