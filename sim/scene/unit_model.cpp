#include "sim/scene/unit_model.h"

#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/rng.h"

namespace fathom {

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
  std::vector<std::complex<float>> along(width);
  for (int wave = 0; wave < kWaves && unit.residue_px > 0.0; ++wave) {
    Rng rng(unit.serial, kResidueStream, wave);
    const double across = rng.normal() / unit.residue_reach_px, down = rng.normal() / unit.residue_reach_px;
    const double phase = 2.0 * std::numbers::pi * rng.uniform();
    for (int x = 0; x < width; ++x) along[x] = std::polar(amplitude, static_cast<float>(across * (x - margin_px)));
    for (int y = 0; y < height; ++y) {
      const std::complex<float> here = std::polar(1.0f, static_cast<float>(down * y + phase));
      for (int x = 0; x < width; ++x) residue(x, y) += here.real() * along[x].real() - here.imag() * along[x].imag();
    }
  }
  if (!unit.learned.map) return residue;
  const int above = (height - unit.learned.map->reference.height()) / 2;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      residue(x, y) += unit.learned.map->reference_of(x - margin_px + 0.5, y - above + 0.5);
  return residue;
}

UnitModel unit_from_json(const JsonReader& json, UnitModel unit) {
  if (json.value().is_string()) {
    unit.learned = learned_unit_from_json(json);
    unit.residue_px = 0.0;
    return unit;
  }
  json.allow_only({"learned", "disparity_offset_px", "disparity_sigma_px", "scale_sigma", "serial", "residue_px",
                   "residue_reach_px", "warm_up_px", "warm_up_s", "on_for_s", "wander_px", "frame_interval_s"});
  if (json.has("learned")) unit.learned = learned_unit_from_json(json.at("learned"));
  unit.disparity_offset_px = json.number_or("disparity_offset_px", unit.disparity_offset_px, {-4.0, 4.0});
  unit.wander_px = json.number_or("wander_px", unit.wander_px, {0.0, 4.0});
  unit.disparity_sigma_px = json.number_or("disparity_sigma_px", unit.disparity_sigma_px, {0.0, 4.0});
  unit.scale_sigma = json.number_or("scale_sigma", unit.scale_sigma, {0.0, 0.1});
  unit.serial = static_cast<std::uint64_t>(json.integer_or("serial", static_cast<int>(unit.serial), 0, 1 << 30));
  unit.residue_px = json.number_or("residue_px", unit.residue_px, {0.0, 4.0});
  unit.residue_reach_px = json.number_or("residue_reach_px", unit.residue_reach_px, {4.0, 1000.0});
  unit.warm_up_px = json.number_or("warm_up_px", unit.warm_up_px, {-4.0, 4.0});
  unit.warm_up_s = json.number_or("warm_up_s", unit.warm_up_s, kPositive);
  unit.on_for_s = json.number_or("on_for_s", unit.on_for_s, kNonNegative);
  unit.frame_interval_s = json.number_or("frame_interval_s", unit.frame_interval_s, kPositive);
  return unit;
}

Json json_from_unit(const UnitModel& unit) {
  Json json = {{"disparity_offset_px", unit.disparity_offset_px},
               {"wander_px", unit.wander_px},
               {"disparity_sigma_px", unit.disparity_sigma_px},
               {"scale_sigma", unit.scale_sigma},
               {"serial", unit.serial},
               {"residue_px", unit.residue_px},
               {"residue_reach_px", unit.residue_reach_px},
               {"warm_up_px", unit.warm_up_px},
               {"warm_up_s", unit.warm_up_s},
               {"on_for_s", unit.on_for_s},
               {"frame_interval_s", unit.frame_interval_s}};
  if (unit.learned.map) json["learned"] = unit.learned.file;
  return json;
}

}  // namespace fathom
