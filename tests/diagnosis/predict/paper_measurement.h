// A campaign with the paper's sensor and cup: five fillings at three distances.
#pragma once

#include "diagnosis/measurement/named_values.h"
#include "diagnosis/measurement/read_measurement.h"
#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {

/// Observations of everything that clouds of a campaign would give, without values.
inline Measurement paper_measurement(bool bare_desk) {
  Measurement measurement;
  measurement.rig = paper_laboratory();
  int pour = 0, placement = 0;
  const auto add = [&](const Factors& factors, const char* observable, std::string_view region) {
    Observation& observation = measurement.observations.emplace_back();
    observation.observable = observable;
    observation.factors = factors;
    observation.factors.region = region;
    observation.repeats = 10;
  };
  const auto add_desk = [&](const Factors& factors) {
    for (const char* observable : {"desk_height_mm", "desk_pitch_deg", "desk_roll_deg"})
      add(factors, observable, "desk");
    for (const std::string_view region : kDeskRegionNames) add(factors, "desk_residual_mm", region);
  };
  Factors factors;
  factors.liquid = "none";
  if (bare_desk) add_desk(factors);
  for (const auto& [liquid, fill_mm] :
       {std::pair{"empty", 0.0}, {"water", 10.0}, {"water", 30.0}, {"milk", 10.0}, {"milk", 30.0}}) {
    for (const double distance_mm : {200.0, 300.0, 400.0}) {
      factors.liquid = liquid;
      factors.fill_mm = fill_mm;
      factors.distance_mm = distance_mm;
      factors.pour = pour;
      factors.placement = placement++;
      factors.time_s = 10.0 * factors.placement;
      for (const std::string_view region : kCupRegionNames) add(factors, "height_mm", region);
      add(factors, "height_sd_mm", kWholeInterior);
      add_desk(factors);
    }
    ++pour;
  }
  return measurement;
}

}  // namespace fathom
