#include "sim/scene/unit_model.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/fields.h"
#include "core/rng.h"
#include "core/simd.h"

namespace fathom {
namespace {

/// Adds amplitude · cos(a + b) to a row: `cosines` and `sines` are amplitude · cos a and amplitude · sin a of its
/// pixels, `cosine` and `sine` are cos b and sin b.
FATHOM_SIMD_CLONES
void add_wave(const float* __restrict cosines, const float* __restrict sines, float cosine, float sine,
              float* __restrict sum, int width) {
  for (int x = 0; x < width; ++x) sum[x] += cosine * cosines[x] - sine * sines[x];
}

}  // namespace

UnitError unit_error(const UnitModel& unit, std::uint64_t frame) {
  constexpr std::uint64_t kUnitStream = 0x756e6974ULL;
  constexpr std::uint64_t kWanderStream = 0x77616e646572ULL;
  Rng rng(unit.serial, kUnitStream);
  const double seconds = unit.on_for_s + static_cast<double>(frame) * unit.frame_interval_s;
  UnitError error;
  error.offset_px = unit.disparity_offset_px + unit.disparity_sigma_px * rng.normal() +
                    unit.warm_up_px * std::exp(-seconds / unit.warm_up_s);
  if (unit.wander_px > 0.0)
    error.offset_px += unit.wander_px * Rng(unit.serial, kWanderStream, std::bit_cast<std::uint64_t>(seconds)).normal();
  error.scale = 1.0 + unit.scale_sigma * rng.normal();
  return error;
}

Image<float> reference_residue(const UnitModel& unit, int margin_px, int width, int height) {
  if (unit.residue_px == 0.0 && !unit.learned.map) return {};
  constexpr std::uint64_t kResidueStream = 0x72657369ULL;
  constexpr int kWaves = 64;
  // Waves at random, of wave numbers as the covariance's spectrum has them (Rahimi & Recht 2007).
  Image<float> residue(width, height);
  const auto amplitude = static_cast<float>(unit.residue_px * std::sqrt(2.0 / kWaves));
  std::vector<float> cosines(width), sines(width);
  for (int wave = 0; wave < kWaves && unit.residue_px > 0.0; ++wave) {
    Rng rng(unit.serial, kResidueStream, wave);
    const double across = rng.normal() / unit.residue_reach_px, down = rng.normal() / unit.residue_reach_px;
    const double phase = 2.0 * std::numbers::pi * rng.uniform();
    for (int x = 0; x < width; ++x) {
      const auto angle = static_cast<float>(across * (x - margin_px));
      cosines[x] = amplitude * std::cos(angle), sines[x] = amplitude * std::sin(angle);
    }
    for (int y = 0; y < height; ++y) {
      const auto angle = static_cast<float>(down * y + phase);
      add_wave(cosines.data(), sines.data(), std::cos(angle), std::sin(angle), residue.row(y), width);
    }
  }
  if (!unit.learned.map) return residue;
  const int above = (height - unit.learned.map->reference.height()) / 2;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      residue(x, y) += unit.learned.map->reference_of(x - margin_px + 0.5, y - above + 0.5);
  return residue;
}

std::span<const Field<UnitModel>> unit_fields() {
  constexpr Range kSerial{0.0, 1 << 30};
  static const Field<UnitModel> fields[] = {
      {"disparity_offset_px",
       &UnitModel::disparity_offset_px,
       {-4.0, 4.0},
       "constant bias of this device's disparities"},
      {"wander_px",
       &UnitModel::wander_px,
       {0.0, 4.0},
       "standard deviation of an error that all disparities of a frame share"},
      {"disparity_sigma_px",
       &UnitModel::disparity_sigma_px,
       {0.0, 4.0},
       "spread of the disparity's zero from unit to unit"},
      {"scale_sigma", &UnitModel::scale_sigma, {0.0, 0.1}, "relative spread of focal length times baseline"},
      {"serial", &UnitModel::serial, kSerial,
       "which unit this is: it draws its errors and the speckle of its reference image"},
      {"residue_px",
       &UnitModel::residue_px,
       {0.0, 4.0},
       "standard deviation over the image of this device's fixed disparity error, which differs from place to place"},
      {"residue_reach_px", &UnitModel::residue_reach_px, {4.0, 1000.0}, "distance over which that error changes"},
      {"warm_up_px", &UnitModel::warm_up_px, {-4.0, 4.0}, "additional disparity of a cold device"},
      {"warm_up_s", &UnitModel::warm_up_s, kPositive, "time in which that falls to 1/e"},
      {"on_for_s", &UnitModel::on_for_s, kNonNegative, "time since the unit was switched on, at frame 0"},
      {"frame_interval_s", &UnitModel::frame_interval_s, kPositive, "from frame to frame"},
      {"learned",
       Part<UnitModel>{[](const JsonReader& json, UnitModel& unit) { unit.learned = learned_unit_from_json(json); },
                       [](const UnitModel& unit) { return unit.learned.map ? Json(unit.learned.file) : Json(); },
                       R"({"type": "string"})", "a path"},
       "a unit.json of fathom calibrate, relative to this file; its map of errors is added to those that are drawn"}};
  return fields;
}

UnitModel unit_from_json(const JsonReader& json, UnitModel unit) {
  if (json.value().is_string()) {
    unit.learned = learned_unit_from_json(json);
    unit.residue_px = 0.0;
    return unit;
  }
  read_fields(json, unit_fields(), unit);
  return unit;
}

}  // namespace fathom
