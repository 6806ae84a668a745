#include <algorithm>
#include <cmath>

#include "bench/accuracy.h"
#include "bench/sensor_scenes.h"
#include "core/units.h"

namespace fathom {
namespace {

double mean_depth_mm(const Setup& setup, std::uint64_t seed = 1, CaptureMode mode = CaptureMode::photometric) {
  const Frame frame = shoot(setup, seed, mode);
  double sum = 0.0, count = 0.0;
  for (const float depth : frame.depth.pixels())
    if (depth > 0.0f) sum += depth, ++count;
  return mm_from_metres(sum / count);
}

/// Eighteen units before one wall, as Boehm 2014 had them; without images, as only calibration differs.
void compare_units() {
  constexpr double kDistance = 3.0;  // [m]
  constexpr std::uint64_t kUnits = 18;
  Setup wall = facing_wall(kDistance);
  wall.rig.sensor.unit.disparity_sigma_px = 0.1;
  wall.rig.sensor.unit.scale_sigma = 0.003;
  double largest_mm = 0.0, again_mm = 0.0;
  for (std::uint64_t serial = 1; serial <= kUnits; ++serial) {
    wall.rig.sensor.unit.serial = serial;
    const double mean_mm = mean_depth_mm(wall, 1, CaptureMode::geometric);
    largest_mm = std::max(largest_mm, std::fabs(mean_mm - mm_from_metres(kDistance)));
    again_mm = std::max(again_mm, std::fabs(mean_depth_mm(wall, 2, CaptureMode::geometric) - mean_mm));
  }
  print_figure("18 units at 3 m: largest error of a mean [mm]", largest_mm, std::nullopt, "Boehm: a few cm",
               Bar{10.0, 60.0});
  print_figure("         largest difference of two shots [mm]", again_mm, std::nullopt, "Boehm: a few mm",
               Bar{0.0, 5.0});
  print_note("disparity_sigma_px 0.1 and scale_sigma 0.003, chosen for this; the models of units leave both at 0.");
}

}  // namespace

void compare_times() {
  print_title("Sixteen frames of a still wall turned by 5 degrees: deviation of a pixel's depth [mm]");
  const auto noise = [](const Setup& wall) {
    Camera camera(wall, CaptureMode::photometric, kDefaultSamplesPerPixel, 1);
    return temporal_noise(camera);
  };
  const TemporalNoise near = noise(facing_wall(1.063, 5.0)), far = noise(facing_wall(2.9, 5.0));
  print_figure("1.06 m: mean (fitted: speckle_renewed)", near.mean_mm, 1.05, "measured", within_factor(1.05, 1.5));
  print_figure("        median", near.median_mm, std::nullopt, "");
  print_figure("2.9 m: median", far.median_mm, 2.62, "measured");
  print_figure("       mean", far.mean_mm, std::nullopt, "");
  print_note("Measured, a pixel wanders by 0.32 steps at 1.06 m and by 0.11 at 2.9 m; the scenes are not described.");

  print_title("One unit beside another, and warming up");
  Setup wall = facing_wall(2.5);
  wall.rig.sensor.unit.warm_up_px = 0.17;
  wall.rig.sensor.law.quantized = false;  // steps of 18 mm would hide it
  const auto after = [&](double minutes) {
    wall.rig.sensor.unit.on_for_s = 60.0 * minutes;
    return mean_depth_mm(wall);
  };
  const double cold = after(0.0);
  print_figure("warm_up_px 0.17: first 6 min at 2.5 m [mm]", after(6.0) - cold, 8.17, "measured (fitted)",
               within_share(8.17, 0.1));
  print_figure("                 70th minute [mm/min]", (after(75.0) - after(65.0)) / 10.0, 0.02, "measured (fitted)");
  compare_units();
}

}  // namespace fathom
