#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "bench/accuracy.h"
#include "bench/bench_scene.h"
#include "core/estimate.h"
#include "core/json.h"
#include "core/units.h"

namespace fathom {
namespace {

constexpr std::array kLiquids{"milk_tea", "orange_juice", "tomato_juice", "skim_milk", "whole_milk"};
constexpr std::array kFills_mm{20, 40, 60};
constexpr std::array kSensorHeights_mm{450, 650, 850};
constexpr int kPlaces = 8;                      ///< of the cup, each with a speckle of its own
constexpr int kIrWidth = 400, kIrHeight = 320;  ///< infrared pixels about the middle, in which all of the cup lies

/// One place of the cup moves it by part of the distance between dots.
Setup turbid_scene(const char* liquid, int fill_mm, int height_mm, int place) {
  const double y_mm = 300.0 * height_mm / 650.0, off_mm = 1.7 * place;
  return crop(setup_from_json(Json::parse(fmt::format(
                                  R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": {}, "aim_mm": [0, {}, 0]}},
        "cups": [{{"shape": "paper_cup", "position_mm": [{}, {}], "liquid": "{}", "fill_mm": {}}}]}})",
                                  height_mm, y_mm, off_mm, y_mm + 0.6 * off_mm, liquid, fill_mm)),
                              "cup"),
              kIrWidth, kIrHeight);
}

/// What is measured of a liquid's surface.
struct MeasuredLiquid {
  double matched;         ///< share of its pixels that have a disparity
  double right;           ///< number of pixels that are not matched wrongly
  double above_mm = 0.0;  ///< mean of what they measure above the surface
};

/// Mean over the pixels of several frames; its error from how the frames differ.
class OverPixels {
 public:
  void add(const MeasuredLiquid& frame) { frames_.push_back(frame); }

  Estimate above_mm() const {
    double pixels = 0.0, sum = 0.0, squares = 0.0;
    for (const MeasuredLiquid& frame : frames_) pixels += frame.right, sum += frame.right * frame.above_mm;
    const double mean = sum / pixels;
    for (const MeasuredLiquid& frame : frames_) squares += std::pow(frame.right * (frame.above_mm - mean), 2.0);
    return {mean, std::sqrt(squares) / pixels};
  }

 private:
  std::vector<MeasuredLiquid> frames_;
};

MeasuredLiquid measured_liquid(const Setup& setup, CaptureMode mode, std::uint64_t seed) {
  constexpr double kWrong_mm = 15.0;
  Camera camera(setup, mode, kDefaultSamplesPerPixel, seed);
  const Frame frame = camera.shoot(0);
  const Rig& rig = camera.setup().rig;
  const Eigen::Vector3d eye = rig.camera_in_world(), forward = rig.world_from_camera.linear().col(2);
  const double depth_px = rig.sensor.focal_px * rig.sensor.baseline;
  int seen = 0, matched = 0;
  Mean above;
  for (std::size_t i = 0; i < camera.truth().size(); ++i) {
    const TruePixel& pixel = camera.truth().pixels()[i];
    if (pixel.path != PathKind::scattered) continue;
    ++seen;
    const double disparity = frame.disparity_px.pixels()[i];
    if (disparity <= 0.0) continue;
    ++matched;
    const Eigen::Vector3d to = pixel.position - eye;
    const double off_mm = mm_from_metres(to.z() * (depth_px / disparity / forward.dot(to) - 1.0));
    if (std::fabs(off_mm) < kWrong_mm) above.add(off_mm);
  }
  const bool is_seen = above.count() > 1;
  return {static_cast<double>(matched) / seen, static_cast<double>(above.count()),
          is_seen ? above.estimate().value : 0.0};
}

}  // namespace

void compare_turbid() {
  print_title("Geometric frames of liquids that scatter, beside photometric ones");
  constexpr double kShare = 0.05, kHeight_mm = 0.1;
  for (const char* liquid : kLiquids) {
    std::array<Mean, 2> matched;  // geometric, photometric
    std::array<OverPixels, 2> heights;
    Mean apart;
    for (const int fill : kFills_mm)
      for (const int height : kSensorHeights_mm) {
        std::array<Mean, 2> matched_here;
        std::array<OverPixels, 2> heights_here;
        for (int place = 0; place < kPlaces; ++place) {
          const Setup setup = turbid_scene(liquid, fill, height, place);
          std::array<MeasuredLiquid, 2> seen;
          for (int mode = 0; mode < 2; ++mode) {
            seen[mode] =
                measured_liquid(setup, mode == 0 ? CaptureMode::geometric : CaptureMode::photometric, place + 1);
            matched[mode].add(seen[mode].matched), heights[mode].add(seen[mode]);
            matched_here[mode].add(seen[mode].matched), heights_here[mode].add(seen[mode]);
          }
          apart.add(seen[0].matched - seen[1].matched);
        }
        print_note(fmt::format(
            "{}, {} mm deep, sensor at {} mm: matched {:.3f} and {:.3f}, above the surface {:+.2f} and {:+.2f} mm",
            liquid, fill, height, matched_here[0].estimate().value, matched_here[1].estimate().value,
            heights_here[0].above_mm().value, heights_here[1].above_mm().value));
      }
    const double share = matched[1].estimate().value;
    const Estimate above = heights[0].above_mm(), photometric = heights[1].above_mm();
    print_figure(fmt::format("{}: share matched, ±{:.3f}", liquid, apart.estimate().standard_error),
                 matched[0].estimate().value, share, "photometric", within(share, kShare));
    print_figure(
        fmt::format("  above the surface [mm], ±{:.2f}", std::hypot(above.standard_error, photometric.standard_error)),
        above.value, photometric.value, "photometric", within(photometric.value, kHeight_mm));
  }
}

}  // namespace fathom
