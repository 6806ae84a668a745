#include "sim/scene/noise.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace fathom {
namespace {

/// Per-dot speckle and detector noise of Landau, Choo & Beling (2016); the shot noise's 10 electrons per DN are an
/// estimate.
NoiseModel basic() {
  NoiseModel noise;
  noise.speckle_shape = 4.54;
  noise.electrons_per_dn = 10.0;
  noise.read_dn = 10.4;
  noise.bits = 10;
  return noise;
}

/// Their constants as published: dots Gamma(4.54, 0.196), of mean 0.89; detector N(−0.126, 10.4) [DN].
NoiseModel landau_2016() {
  NoiseModel noise;
  noise.speckle_shape = 4.54;
  noise.speckle_mean = 0.89;
  noise.read_dn = 10.4;
  noise.offset_dn = -0.126;
  noise.bits = 10;
  return noise;
}

/// Speckle as the lens makes it, in the reference image as well. The share that is renewed is fitted to the temporal
/// deviation of a box face at 1.06 m, 1.05 mm; shot and read noise, ambient light and spill are estimates. The
/// disparity's statistics are fitted to the deviations that measured desks show, and to that of the box face.
NoiseModel device() {
  NoiseModel noise;
  noise.pixel_speckle = 1.0;
  noise.reference_speckle = 1.0;
  noise.speckle_renewed = 0.27;
  noise.ambient_dn = 4.0;
  noise.electrons_per_dn = 10.0;
  noise.read_dn = 2.0;
  noise.bloom_share = 0.5;
  noise.bits = 10;
  noise.disparity = {.facing_px = 0.0559, .lateral_px = 0.45, .renewed = 0.27};
  return noise;
}

const std::array<std::pair<std::string, NoiseModel>, 4>& presets() {
  static const std::array<std::pair<std::string, NoiseModel>, 4> all{
      {{"off", NoiseModel{}}, {"basic", basic()}, {"landau_2016", landau_2016()}, {"device", device()}}};
  return all;
}

struct Part {
  const char* key;
  double NoiseModel::*value;
  Range range;
};

constexpr Range kShare{0.0, 1.0};
const std::array<Part, 12> kParts{{{"speckle_shape", &NoiseModel::speckle_shape, kNonNegative},
                                   {"speckle_mean", &NoiseModel::speckle_mean, kPositive},
                                   {"pixel_speckle", &NoiseModel::pixel_speckle, kShare},
                                   {"reference_speckle", &NoiseModel::reference_speckle, kShare},
                                   {"speckle_renewed", &NoiseModel::speckle_renewed, kShare},
                                   {"ambient_dn", &NoiseModel::ambient_dn, kNonNegative},
                                   {"gain", &NoiseModel::gain, kPositive},
                                   {"electrons_per_dn", &NoiseModel::electrons_per_dn, kNonNegative},
                                   {"read_dn", &NoiseModel::read_dn, kNonNegative},
                                   {"offset_dn", &NoiseModel::offset_dn, {-1024.0, 1024.0}},
                                   {"bloom_share", &NoiseModel::bloom_share, kShare},
                                   {"bloom_ir_px", &NoiseModel::bloom_ir_px, {0.5, 64.0}}}};

DisparityNoise disparity_from_json(const JsonReader& json) {
  json.allow_only({"facing_px", "lateral_px", "renewed"});
  DisparityNoise noise;
  noise.facing_px = json.number_or("facing_px", noise.facing_px, {0.0, 4.0});
  noise.lateral_px = json.number_or("lateral_px", noise.lateral_px, {0.0, 16.0});
  noise.renewed = json.number_or("renewed", noise.renewed, kShare);
  return noise;
}

}  // namespace

NoiseModel basic_noise() { return basic(); }

NoiseModel noise_from_json(const JsonReader& json) {
  if (json.value().is_string()) {
    std::vector<std::string> names;
    for (const auto& preset : presets()) names.push_back(preset.first);
    return presets()[json.choice(names, "noise preset")].second;
  }
  json.allow_only({"speckle_shape", "speckle_mean", "pixel_speckle", "reference_speckle", "speckle_renewed",
                   "ambient_dn", "gain", "electrons_per_dn", "read_dn", "offset_dn", "bloom_share", "bloom_ir_px",
                   "bits", "disparity"});
  NoiseModel noise;
  for (const Part& part : kParts) noise.*part.value = json.number_or(part.key, noise.*part.value, part.range);
  if (noise.speckle_shape > 0.0 && noise.speckle_shape < 1.0)
    json.fail_at("speckle_shape", "must be 0 (none) or at least 1 (fully developed speckle)");
  noise.bits = json.integer_or("bits", 0, 0, 16);
  if (json.has("disparity")) noise.disparity = disparity_from_json(json.at("disparity"));
  return noise;
}

Json json_from_noise(const NoiseModel& noise) {
  Json json = Json::object();
  for (const Part& part : kParts) json[part.key] = noise.*part.value;
  json["bits"] = noise.bits;
  json["disparity"] = {{"facing_px", noise.disparity.facing_px},
                       {"lateral_px", noise.disparity.lateral_px},
                       {"renewed", noise.disparity.renewed}};
  return json;
}

}  // namespace fathom
