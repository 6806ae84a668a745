#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "bench/accuracy.h"
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

void compare_pots(CaptureMode mode) {
  print_title("Empty pot, 104 mm high, 560 mm away: mean height of its floor [mm] (registered to colour)");
  const std::array<std::pair<std::string_view, std::pair<int, int>>, 3> pots{
      {{"learn36", {40, 44}}, {"learn37", {40, 43}}, {"learn38", {50, 53}}}};
  std::vector<Floor> measured;
  for (const DeskImage& image : measured_desks())
    for (const auto& [name, labels] : pots)
      if (image.name == name) measured.push_back(floor_of(image, labels));
  for (const Floor& floor : measured) print_floor("measured", floor);
  if (measured.size() < pots.size()) print_note("skipped: no measured clouds (FATHOM_REAL_DATA)");

  // Put down as the measured ones: at one place, and twice at another; before several units.
  constexpr std::uint64_t kUnits = 4;
  constexpr std::array kRight{40.0, 98.0, 98.0};
  double variance = 0.0, from_points = 0.0, mean = 0.0, again = 0.0;
  for (std::uint64_t unit = 0; unit < kUnits; ++unit) {
    std::vector<Floor> floors;
    for (std::size_t scene = 0; scene < kRight.size(); ++scene) {
      Setup setup = desk_twin(fmt::format(R"(, "cups": [{{"shape": {{"height_mm": 104, "bottom_mm": 4,
        "inner_radius_mm": 82.5, "outer_radius_mm": 84.5, "albedo": 0.5}}, "position_mm": [{}, {}]}}])",
                                          kRight[scene] - 37.5, scene == 0 ? 554.0 : 548.0));
      setup.rig.sensor.unit.serial = unit;
      const auto image =
          with_desk("twin", registered_to_colour(shoot(setup, 1 + scene + kRight.size() * unit, mode).depth,
                                                 setup.rig.sensor.focal_px, kColourFocalPx));
      if (!image) continue;
      floors.push_back(floor_of(*image, {0, 0}));
      print_floor(fmt::format("unit {}", unit), floors.back());
    }
    const Scatter scatter = scatter_of(floors);
    variance += scatter.deviation_mm * scatter.deviation_mm / kUnits;
    from_points += scatter.from_points_mm / kUnits, mean += scatter.mean_mm / kUnits;
    again += std::fabs(floors[2].mean_mm - floors[1].mean_mm) / kUnits;
  }
  const bool whole = measured.size() == pots.size();
  const std::optional<Scatter> theirs = whole ? std::optional(scatter_of(measured)) : std::nullopt;
  print_figure("deviation of the mean, scene to scene", std::sqrt(variance), theirs ? theirs->deviation_mm : 0.59,
               "measured", Bar{0.3, 0.9});
  print_figure("  if points were independent", from_points, 0.04, "measured");
  print_figure("  at the same place again", again, whole ? std::fabs(measured[2].mean_mm - measured[1].mean_mm) : 0.2,
               "measured");
  print_figure("mean over the scenes, true 4", mean, theirs ? theirs->mean_mm : 4.23, "measured");
  print_note("The deviation is of place: the reference image is displaced, as nine measured desks have in common");
  print_note("(0.68 steps of 1/8 px in cells of 20 px, two thirds of it left 50 px further; scene to scene 0.27).");
}

}  // namespace fathom
