#include "sim/scene/unit_model.h"

#include <cmath>

#include "core/rng.h"

namespace fathom {

UnitError unit_error(const UnitModel& unit, std::uint64_t frame) {
  constexpr std::uint64_t kUnitStream = 0x756e6974ULL;
  constexpr double kFramesPerSecond = 30.0;
  Rng rng(unit.serial, kUnitStream);
  const double seconds = unit.on_for_s + static_cast<double>(frame) / kFramesPerSecond;
  UnitError error;
  error.offset_px = unit.disparity_sigma_px * rng.normal() + unit.warm_up_px * std::exp(-seconds / unit.warm_up_s);
  error.scale = 1.0 + unit.scale_sigma * rng.normal();
  return error;
}

UnitModel unit_from_json(const JsonReader& json, UnitModel unit) {
  json.allow_only({"disparity_sigma_px", "scale_sigma", "serial", "warm_up_px", "warm_up_s", "on_for_s"});
  unit.disparity_sigma_px = json.number_or("disparity_sigma_px", unit.disparity_sigma_px, {0.0, 4.0});
  unit.scale_sigma = json.number_or("scale_sigma", unit.scale_sigma, {0.0, 0.1});
  unit.serial = static_cast<std::uint64_t>(json.integer_or("serial", static_cast<int>(unit.serial), 0, 1 << 30));
  unit.warm_up_px = json.number_or("warm_up_px", unit.warm_up_px, {-4.0, 4.0});
  unit.warm_up_s = json.number_or("warm_up_s", unit.warm_up_s, kPositive);
  unit.on_for_s = json.number_or("on_for_s", unit.on_for_s, kNonNegative);
  return unit;
}

Json json_from_unit(const UnitModel& unit) {
  return {{"disparity_sigma_px", unit.disparity_sigma_px},
          {"scale_sigma", unit.scale_sigma},
          {"serial", unit.serial},
          {"warm_up_px", unit.warm_up_px},
          {"warm_up_s", unit.warm_up_s},
          {"on_for_s", unit.on_for_s}};
}

}  // namespace fathom
