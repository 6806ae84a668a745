#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bench/accuracy.h"
#include "bench/desk_noise.h"
#include "bench/sensor_scenes.h"
#include "core/units.h"
#include "sim/sensor/depth.h"

namespace fathom {
namespace {

/// Khoshelham & Elberink 2012, and Nguyen, Izadi & Lovell 2012 for a surface that faces the sensor [m].
double khoshelham(double z) { return 1.425e-3 * z * z; }
double nguyen(double z) { return 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4); }

bool on_law(const SensorModel& sensor, float depth) {
  const int code = device_code(sensor, depth);
  for (int n = code - 2; n <= code + 2; ++n)
    if (const auto z = device_depth(sensor, n); z && static_cast<float>(*z) == depth) return true;
  return false;
}

}  // namespace

void compare_ranges(CaptureMode mode) {
  print_title("Facing wall, no slope: axial sigma [mm], mean over eight places within a step of disparity");
  constexpr std::array kDistances{0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0};
  double least_valid = 1.0, measured = 0.0, on_device_law = 0.0;
  for (const double distance : kDistances) {
    constexpr int kPlaces = 8;
    double variance = 0.0;
    int windows = 0;
    for (int place = 0; place < kPlaces; ++place) {
      const double step = distance * distance / (8.0 * 575.8 * 0.075);
      const double z = distance + place * step / kPlaces;
      const Setup wall = facing_wall(z);
      const SensorModel& sensor = wall.rig.sensor;
      const Frame frame = shoot(wall, static_cast<std::uint64_t>(place + 1), mode);
      const auto inside = desk_windows(sensor, frame.depth, sensor.focal_px, -Eigen::Vector3d::UnitZ(), -z, 8.0 * step);
      const DeskNoise noise = desk_noise(sensor, inside, 0.0, 2.0 * z);
      variance += noise.windows * noise.sigma * noise.sigma, windows += noise.windows;
      least_valid = std::min(least_valid, valid_share(frame.depth, sensor.matcher.window_columns / 2));
      for (const float depth : frame.depth.pixels())
        if (depth > 0.0f) ++measured, on_device_law += on_law(sensor, depth);
    }
    const double sigma = std::sqrt(variance / windows), low = khoshelham(distance), high = nguyen(distance);
    print_figure(fmt::format("{:.1f} m, beside Khoshelham & Elberink", distance), mm_from_metres(sigma),
                 mm_from_metres(low), "published", within_share(mm_from_metres(low), 0.2));
    print_figure("       beside Nguyen et al., band of both", mm_from_metres(sigma), mm_from_metres(high), "published",
                 Bar{mm_from_metres(low), mm_from_metres(high)});
  }
  print_figure("share of depths on the depth law", on_device_law / measured, 1.0, "exact", Bar{1.0, 1.0});
  print_figure("least valid share inside the border, matte", least_valid, std::nullopt, "", Bar{0.99, 1.0});

  const Setup wall = desk_twin();
  const Image<float> depth = shoot(wall, 1, mode).depth;
  int border = 0;
  for (bool empty = true; empty; border += empty)
    for (int y = 0; y < depth.height() && empty; ++y) empty = depth(border, y) == 0.0f;
  print_figure("border, columns without depth", border, wall.rig.sensor.matcher.window_columns / 2, "half a window",
               within(wall.rig.sensor.matcher.window_columns / 2, 1.0));
}

}  // namespace fathom
