#include <fmt/format.h>

#include <array>

#include "bench/accuracy.h"
#include "bench/desk_noise.h"
#include "bench/measured_desks.h"
#include "bench/sensor_scenes.h"
#include "core/units.h"

namespace fathom {
namespace {

/// As published with the clouds' analysis, for where the clouds are absent.
struct Published {
  double distance, from, to;  ///< [m]
  double sigma_steps;
};
constexpr std::array<Published, 5> kDistances{{{0.65, 0.58, 0.72, 0.77},
                                               {0.85, 0.78, 0.92, 0.715},
                                               {1.05, 0.98, 1.12, 0.64},
                                               {1.25, 1.18, 1.32, 0.64},
                                               {1.45, 1.35, 1.55, 0.64}}};
constexpr std::array kPublishedX{0.71, 0.57, 0.36, 0.05};
constexpr std::array kPublishedY{0.55, 0.31, -0.03};

std::vector<DeskWindow> windows_of(const SensorModel& sensor, const DeskImage& image) {
  constexpr double kMostOff = 0.015;  // [m] above or below the desk: five deviations at the far end
  return desk_windows(sensor, image.depth, kColourFocalPx, image.desk.normal, -image.desk.offset, kMostOff);
}

void append(std::vector<DeskWindow>& all, const std::vector<DeskWindow>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// `simulated` windows beside those measured; none measured: beside what was published with the clouds' analysis.
void compare(const SensorModel& sensor, const std::vector<DeskWindow>& simulated,
             const std::vector<DeskWindow>& measured) {
  const std::string_view source = measured.empty() ? "published" : "measured";
  for (const Published& at : kDistances) {
    const DeskNoise sim = desk_noise(sensor, simulated, at.from, at.to);
    const DeskNoise real = desk_noise(sensor, measured, at.from, at.to);
    const auto name = [&](std::string_view what) { return fmt::format("{:.2f} m: {}", at.distance, what); };
    const double sigma = measured.empty() ? at.sigma_steps : real.sigma_steps;
    print_figure(name("sigma [steps of 1/8 px]"), sim.sigma_steps, sigma, source, within_share(sigma, 0.15));
    if (!measured.empty()) {
      print_figure(name("sigma [mm]"), mm_from_metres(sim.sigma), mm_from_metres(real.sigma), source);
      print_figure(name("slow bias [mm]"), mm_from_metres(sim.height), mm_from_metres(real.height), source);
    }
    const auto correlation = [&](char axis, int lag, double ours, double published, double theirs) {
      const double other = measured.empty() ? published : theirs;
      print_figure(name(fmt::format("autocorrelation {} {}", axis, lag)), ours, other, source, within(other, 0.1));
    };
    for (std::size_t i = 0; i < kLagsX.size(); ++i)
      correlation('x', kLagsX[i], sim.correlation_x[i], kPublishedX[i], real.correlation_x[i]);
    for (std::size_t i = 0; i < kLagsY.size(); ++i)
      correlation('y', kLagsY[i], sim.correlation_y[i], kPublishedY[i], real.correlation_y[i]);
  }
}

}  // namespace

void compare_desks(CaptureMode mode) {
  const Setup twin = desk_twin();
  const SensorModel& sensor = twin.rig.sensor;
  std::vector<DeskWindow> measured, simulated;
  const std::vector<DeskImage> clouds = measured_desks();
  for (const DeskImage& image : clouds) append(measured, windows_of(sensor, image));
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    if (const auto image =
            with_desk("twin", registered_to_colour(shoot(twin, seed, mode).depth, sensor.focal_px, kColourFocalPx)))
      append(simulated, windows_of(sensor, *image));
  print_title("Bare desk: windows of 31 x 31 pixels, their plane of disparity removed (registered to colour)");
  if (clouds.empty()) print_note("skipped: no measured clouds (FATHOM_REAL_DATA); published figures instead");
  compare(sensor, simulated, measured);
  if (mode == CaptureMode::geometric) return;
  print_note("Fitted: f-number, dot size, focus, beam and the compression of light, to these sigmas, to the columns'");
  print_note("correlation and to facing walls, all at once. Predicted: the rows' correlation, edges, pots.");
}

}  // namespace fathom
