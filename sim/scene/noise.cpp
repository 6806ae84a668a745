#include "sim/scene/noise.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/fields.h"

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

constexpr Range kShare{0.0, 1.0};

std::span<const Field<DisparityNoise>> disparity_fields() {
  static const Field<DisparityNoise> fields[] = {
      {"facing_px",
       &DisparityNoise::facing_px,
       {0.0, 4.0},
       "standard deviation of the disparity of a surface that faces the sensor, far away"},
      {"lateral_px",
       &DisparityNoise::lateral_px,
       {0.0, 16.0},
       "standard deviation of the random lateral displacement of what a pixel reads, along each axis"},
      {"renewed", &DisparityNoise::renewed, kShare, "share of both variances that each frame draws anew"}};
  return fields;
}

std::span<const Field<NoiseModel>> noise_fields() {
  static const Field<NoiseModel> fields[] = {
      {"speckle_shape", &NoiseModel::speckle_shape, kNonNegative,
       "of the Gamma distribution of the dots' brightness, at least 1; 0: none", false,
       R"({"anyOf": [{"const": 0}, {"type": "number", "minimum": 1}]})"},
      {"speckle_mean", &NoiseModel::speckle_mean, kPositive, "mean of that distribution"},
      {"pixel_speckle", &NoiseModel::pixel_speckle, kShare,
       "share of the light that is coherent and makes speckle on the pixels, with the grain of `optics`"},
      {"reference_speckle", &NoiseModel::reference_speckle, kShare, "the same in the reference image"},
      {"speckle_renewed", &NoiseModel::speckle_renewed, kShare,
       "share of the pixels' speckle that each frame draws anew; all frames of a scene have the rest in common"},
      {"ambient_dn", &NoiseModel::ambient_dn, kNonNegative, "ambient infrared light on albedo 1"},
      {"gain", &NoiseModel::gain, kPositive, "of exposure and amplifier"},
      {"electrons_per_dn", &NoiseModel::electrons_per_dn, kNonNegative,
       "at gain 1; shot noise has the variance signal × gain / this; 0: none"},
      {"read_dn", &NoiseModel::read_dn, kNonNegative, "standard deviation of the detector's own noise"},
      {"offset_dn", &NoiseModel::offset_dn, {-1024.0, 1024.0}, "mean of the detector's own noise"},
      {"bloom_share", &NoiseModel::bloom_share, kShare,
       "share of the light above saturation that spills to the pixels around"},
      {"bloom_ir_px", &NoiseModel::bloom_ir_px, {0.5, 64.0}, "mean distance along each axis that it spills"},
      {"bits", &NoiseModel::bits, {0.0, 16.0}, "of rounding and saturation; 0: none"},
      {"disparity",
       Part<NoiseModel>{
           [](const JsonReader& json, NoiseModel& noise) { read_fields(json, disparity_fields(), noise.disparity); },
           [](const NoiseModel& noise) { return json_from_fields(disparity_fields(), noise.disparity); },
           "#/$defs/disparity_noise", "an object"},
       "noise of geometric captures, which have no image that noise could come from: statistics of measured desks"}};
  return fields;
}

}  // namespace

NoiseModel basic_noise() { return basic(); }

NoiseModel noise_from_json(const JsonReader& json) {
  if (json.value().is_string()) return presets()[json.choice(noise_presets(), "noise preset")].second;
  NoiseModel noise;
  read_fields(json, noise_fields(), noise);
  if (noise.speckle_shape > 0.0 && noise.speckle_shape < 1.0)
    json.fail_at("speckle_shape", "must be 0 (none) or at least 1 (fully developed speckle)");
  return noise;
}

Json json_from_noise(const NoiseModel& noise) { return json_from_fields(noise_fields(), noise); }

std::vector<std::string> noise_presets() {
  std::vector<std::string> names;
  for (const auto& preset : presets()) names.push_back(preset.first);
  return names;
}

std::vector<KeyRow> noise_keys() { return key_rows(noise_fields(), NoiseModel{}); }
std::vector<KeyRow> disparity_noise_keys() { return key_rows(disparity_fields(), DisparityNoise{}); }

}  // namespace fathom
