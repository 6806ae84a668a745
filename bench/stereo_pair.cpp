#include "bench/stereo_pair.h"

#include <algorithm>
#include <limits>

#include "sim/render/truth.h"
#include "sim/sensor/depth.h"
#include "sim/sensor/ir_camera.h"

namespace fathom {
namespace {

/// The middle of an infrared image at the depth image's scale: width × height pixels from column `margin_px` on.
Image<float> halved(const SensorModel& sensor, const Image<float>& ir, int margin_px) {
  const Image<float> half = columns_in_pairs(rows_in_pairs(ir));
  Image<float> middle(sensor.width, sensor.height);
  for (int y = 0; y < sensor.height; ++y)
    for (int x = 0; x < sensor.width; ++x) middle(x, y) = half(x + margin_px, y + sensor.ir_first_row() / 2);
  return middle;
}

/// Full scale of 8 bits stands at the brightest pixels but one in 1000, so that dots use the range.
cv::Mat eight_bits(const Image<float>& image) {
  std::vector<float> sorted(image.pixels().begin(), image.pixels().end());
  const auto brightest = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 999 / 1000);
  std::nth_element(sorted.begin(), brightest, sorted.end());
  const float gain = 255.0f / *brightest;
  cv::Mat result(image.height(), image.width(), CV_8U);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      result.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::clamp(gain * image(x, y) + 0.5f, 0.0f, 255.0f));
  return result;
}

Image<float> true_disparity(const SensorModel& sensor, const Image<TruePixel>& truth) {
  Image<float> disparity(truth.width(), truth.height(), std::numeric_limits<float>::quiet_NaN());
  const double at_reference = disparity_of_depth(sensor, sensor.reference);
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (const std::optional<double>& depth = truth.pixels()[i].apparent_depth)
      disparity.pixels()[i] = static_cast<float>(disparity_of_depth(sensor, *depth) - at_reference);
  return disparity;
}

}  // namespace

StereoPair make_stereo_pair(Setup setup, const NoiseModel& noise) {
  constexpr std::uint64_t kSeed = 1;
  setup.rig.sensor.noise = noise;
  const BenchScene scene(std::move(setup));
  const Rig& rig = scene.setup.rig;
  const SensorModel& sensor = rig.sensor;
  Pattern pattern(sensor.pattern, sensor.ir_scale());
  const int margin = reference_margin(sensor.matcher);
  const Image<float> reference = reference_image(sensor, pattern, margin, kSamplesAcross);
  pattern.set_dot_gains(speckle_gains(noise, pattern, kSeed));
  Image<float> ir = expose(
      render_ir(scene.projector, rig, pattern, kSamplesAcross, LightModel::direct, kSeed).projected, noise, kSeed, 0);

  StereoPair pair;
  pair.sensor = sensor;
  pair.live = eight_bits(halved(sensor, ir, 0));
  pair.halved_reference = eight_bits(halved(sensor, reference, margin));
  pair.ir = std::move(ir);
  pair.reference = memorise(sensor, reference, margin);
  pair.true_disparity_px = true_disparity(sensor, trace_truth(scene.projector, rig));
  return pair;
}

}  // namespace fathom
