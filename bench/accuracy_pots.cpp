#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "bench/accuracy.h"
#include "bench/comparison.h"
#include "bench/measured_desks.h"
#include "bench/sensor_scenes.h"
#include "core/units.h"
#include "detector/circle.h"

namespace fathom {
namespace {

struct Floor {
  double mean_mm, deviation_mm;
  int points;
  double right_mm, away_mm;  ///< where the pot stands, from the camera
};

/// Heights above the desk inside a pot's rim, drawn in by 10 mm; of the things labelled first … last, or of all.
Floor floor_of(const DeskImage& image, std::pair<int, int> labels) {
  constexpr double kRimLow = 0.090, kRimHigh = 0.115, kFloorHigh = 0.015, kDrawnIn = 0.010;  // [m]
  const Eigen::Isometry3d desk_from_camera = fathom::desk_from_camera(image.desk);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> rim;
  for (int y = 0; y < image.depth.height(); ++y)
    for (int x = 0; x < image.depth.width(); ++x) {
      const int label = image.label.empty() ? labels.first : image.label(x, y);
      if (image.depth(x, y) == 0.0f || label < labels.first || label > labels.second) continue;
      points.push_back(desk_from_camera * point_in_colour(image.depth, x, y));
      const double height = points.back().z();
      if (height > kRimLow && height < kRimHigh) rim.push_back(points.back().head<2>());
    }
  const Circle circle = fit_circle(rim).value();
  double sum = 0.0, sum_squares = 0.0;
  int count = 0;
  for (const Eigen::Vector3d& point : points) {
    if ((point.head<2>() - circle.center).norm() > circle.radius_m - kDrawnIn || point.z() > kFloorHigh) continue;
    const double height_mm = mm_from_metres(point.z());
    sum += height_mm, sum_squares += height_mm * height_mm, ++count;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(sum_squares / count - mean * mean), count, mm_from_metres(circle.center.x()),
          mm_from_metres(circle.center.y())};
}

void print_floor(std::string_view whose, const Floor& floor) {
  print_note(fmt::format("{}: {:.2f}, {} points, {:.2f} among them; {:.0f} mm to the right, {:.0f} mm away", whose,
                         floor.mean_mm, floor.points, floor.deviation_mm, floor.right_mm, floor.away_mm));
}

struct Scatter {
  double mean_mm, deviation_mm, from_points_mm;
};
Scatter scatter_of(const std::vector<Floor>& floors) {
  double mean = 0.0, variance = 0.0, expected = 0.0;
  const double n = static_cast<double>(floors.size());
  for (const Floor& floor : floors) mean += floor.mean_mm / n;
  for (const Floor& floor : floors) {
    variance += std::pow(floor.mean_mm - mean, 2.0) / (n - 1.0);
    expected += floor.deviation_mm / std::sqrt(floor.points) / n;
  }
  return {mean, std::sqrt(variance), expected};
}

}  // namespace

void compare_pots() {
  print_title("Empty pot, 104 mm high, 560 mm away: mean height of its floor [mm] (registered to colour)");
  const std::array<std::pair<std::string_view, std::pair<int, int>>, 3> pots{
      {{"learn36", {40, 44}}, {"learn37", {40, 43}}, {"learn38", {50, 53}}}};
  std::vector<Floor> measured;
  for (const DeskImage& image : measured_desks())
    for (const auto& [name, labels] : pots)
      if (image.name == name) measured.push_back(floor_of(image, labels));
  for (const Floor& floor : measured) print_floor("measured", floor);
  if (measured.size() < pots.size()) print_note("skipped: no measured clouds (FATHOM_REAL_DATA)");

  std::vector<Floor> simulated;
  constexpr int kScenes = 8;
  for (int scene = 0; scene < kScenes; ++scene) {
    // Put down anew each time, in another place.
    const Setup setup = desk_twin(fmt::format(R"(, "cups": [{{"shape": {{"height_mm": 104, "bottom_mm": 4,
        "inner_radius_mm": 82.5, "outer_radius_mm": 84.5, "albedo": 0.5}}, "position_mm": [{}, {}]}}])",
                                              17.0 * scene - 20.0, 556.0 + 4.0 * (scene % 3)));
    const auto image = with_desk(
        "twin", in_colour_view(shoot(setup, static_cast<std::uint64_t>(scene + 1)).depth, setup.rig.sensor.focal_px));
    if (image) simulated.push_back(floor_of(*image, {0, 0}));
    if (image) print_floor("simulated", simulated.back());
  }
  const Scatter ours = scatter_of(simulated);
  print_figure("deviation of the mean, scene to scene", ours.deviation_mm,
               measured.size() > 1 ? std::optional(scatter_of(measured).deviation_mm) : std::optional(0.59), "measured",
               Bar{0.3, 0.9});
  print_note(
      "Noise of the measured autocorrelation leaves 0.15 to 0.2 of it. The measured rest goes with the place: a");
  print_note("pot that was not moved reads the same within 0.25, moved by 58 mm it reads 1.1 more.");
  print_figure("  if points were independent", ours.from_points_mm, 0.04, "measured");
  print_figure("mean over the scenes, true 4", ours.mean_mm,
               measured.empty() ? std::optional(4.23) : std::optional(scatter_of(measured).mean_mm), "measured");
}

}  // namespace fathom
