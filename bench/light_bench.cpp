// All the light of one infrared image: what it costs, and how much of its walks' chance is left in it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <regex>
#include <string>
#include <utility>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/embree_loop.h"
#include "bench/measure.h"
#include "bench/ray_recorder.h"
#include "core/files.h"
#include "core/json.h"
#include "core/median.h"
#include "sim/sensor/ir_camera.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

struct Case {
  BenchScene scene;
  Pattern pattern;
  EmbreeLoop embree;

  explicit Case(const Setup& setup) : scene(setup), pattern(with_speckle(1)), embree(scene.geometry) {}

  Pattern with_speckle(std::uint64_t seed) const {
    const SensorModel& sensor = scene.setup.rig.sensor;
    Pattern result(sensor.pattern, sensor.ir_scale());
    result.set_dot_gains(speckle_gains(sensor.noise, result, seed));
    return result;
  }

  Image<float> image(const Pattern& of_projector, std::uint64_t seed) const {
    return render_ir(scene.projector, scene.setup.rig, of_projector, kSamplesAcross, LightModel::full, seed).projected;
  }
};

/// Standard deviations of one image, over the pixels that see a cup or a liquid: of the infrared image by root mean
/// squares [DN], of the disparities that are matched in it by medians [px], scaled to what they are of a Gaussian.
struct Noise {
  double of_walks;      ///< by another seed of the walks
  double of_sensor;     ///< by another speckle; shot noise, read noise and rounding as the sensor's model states them
  double of_walks_px;   ///< by another seed of the walks, all else equal
  double of_sensor_px;  ///< by another speckle, shot noise and read noise
};

/// Median deviation of what two images of disparities differ by, where both have one, as the deviation of one image.
double median_deviation(const Image<float>& a, const Image<float>& b, const std::vector<Eigen::Vector2i>& pixels) {
  std::vector<double> apart;
  for (const Eigen::Vector2i& at : pixels) {
    const float one = a(at.x(), at.y()), other = b(at.x(), at.y());
    if (one > 0.0f && other > 0.0f) apart.push_back(std::abs(one - other));
  }
  if (apart.empty()) return 0.0;
  constexpr double kSigmaPerMedian = 1.4826;
  return kSigmaPerMedian * median(std::move(apart)) / std::sqrt(2.0);
}

Noise noise_of(const Case& measured) {
  const Rig& rig = measured.scene.setup.rig;
  const NoiseModel& model = rig.sensor.noise;
  constexpr int kPairs = 7;  // one alone leaves the walks' noise uncertain by a tenth: pixels share walks
  const Image<float> image = measured.image(measured.pattern, 1),
                     other_speckle = measured.image(measured.with_speckle(2), 1);
  const std::vector<Eigen::Vector2i> pixels = pixels_on_cups(measured.scene.projector, rig);
  double walks = 0.0, sensor = 0.0;
  Image<float> before, other_walks = image;
  for (int pair = 1; pair <= kPairs; ++pair) {
    before = std::exchange(other_walks, measured.image(measured.pattern, 1 + pair));
    for (const Eigen::Vector2i& at : pixels)
      walks += 0.5 / kPairs * std::pow(before(at.x(), at.y()) - other_walks(at.x(), at.y()), 2);
  }
  for (const Eigen::Vector2i& at : pixels) {
    const double value = image(at.x(), at.y());
    sensor += 0.5 * std::pow(value - other_speckle(at.x(), at.y()), 2) + value / model.electrons_per_dn +
              model.read_dn * model.read_dn + 1.0 / 12.0;
  }
  const auto reference =
      reference_image(rig.sensor, Pattern(rig.sensor.pattern, rig.sensor.ir_scale()), kSamplesAcross);
  const auto disparity = [&](const Image<float>& light, std::uint64_t frame) {
    return match(rig.sensor, expose(light, model, 1, frame), *reference);
  };
  std::vector<Eigen::Vector2i> depth_pixels;
  for (const Eigen::Vector2i& at : pixels) {
    const Eigen::Vector2i depth_pixel(at.x() / 2, (at.y() - rig.sensor.ir_first_row()) / 2);
    if (at.x() % 2 == 0 && at.y() % 2 == 0 && depth_pixel.y() >= 0 && depth_pixel.y() < rig.sensor.height)
      depth_pixels.push_back(depth_pixel);
  }
  const Image<float> matched = disparity(image, 0);
  const double count = static_cast<double>(pixels.size());
  return {std::sqrt(walks / count), std::sqrt(sensor / count),
          median_deviation(matched, disparity(other_walks, 0), depth_pixels),
          median_deviation(matched, disparity(other_speckle, 1), depth_pixels)};
}

}  // namespace

void register_light() {
  struct Subject {
    const char* name;
    const char* file;
    const char* liquid;  ///< that takes the place of the file's; nullptr: none
  };
  constexpr std::array kSubjects{Subject{"paper_water", "paper_water.json", nullptr},
                                 Subject{"barley_tea", "paper_water.json", "barley_tea"},
                                 Subject{"meniscus_water", "meniscus_water.json", nullptr},
                                 Subject{"paper_milk_tea", "paper_milk_tea.json", nullptr},
                                 Subject{"orange_juice", "paper_milk_tea.json", "orange_juice"},
                                 Subject{"tomato_juice", "paper_milk_tea.json", "tomato_juice"},
                                 Subject{"whole_milk", "paper_milk_tea.json", "whole_milk"},
                                 Subject{"glass_water", "glass_water.json", nullptr}};
  const std::regex asked(benchmark::GetBenchmarkFilter());
  for (const auto& [name, file, liquid] : kSubjects) {
    const std::string ours = fmt::format("light/{}/fathom", name), beside = fmt::format("light/{}/embree", name);
    if (!std::regex_search(ours, asked) && !std::regex_search(beside, asked)) continue;
    const std::filesystem::path path = data_directory() / file;
    Json json = read_json(path);
    if (liquid) json.at("cups").at(0)["liquid"] = liquid;
    const auto measured = std::make_shared<const Case>(setup_from_json(json, path.string()));
    const Noise noise = noise_of(*measured);
    measure(ours,
            {{"walks_dn", noise.of_walks},
             {"sensor_dn", noise.of_sensor},
             {"walks_px", noise.of_walks_px},
             {"sensor_px", noise.of_sensor_px}},
            [measured] { benchmark::DoNotOptimize(measured->image(measured->pattern, 1)); });
    measure_embree(beside, {measured, &measured->embree},
                   record_camera_rays(measured->scene.world, measured->scene.setup.rig, kSamplesAcross));
  }
}

}  // namespace fathom
