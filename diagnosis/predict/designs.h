// What a laboratory could measure next, and what the model expects there.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/decision/next_measurement.h"
#include "diagnosis/measurement/read_measurement.h"

namespace fathom {

/// One more session with the same sensor and cup: every filling is poured and put down at every place.
struct MeasurementPlan {
  std::string name;  ///< "the empty cup at 4 places"
  int bare_desk_views = 0;
  std::vector<std::pair<std::string, double>> fillings{};  ///< liquid and fill [mm]; "empty" and 0
  std::vector<double> distances_mm{}, laterals_mm{};
  int pours = 1, placements = 2, trials = 3;
  double wait_min = 0.0;                      ///< before every placement
  std::map<std::string, SharedJson> media{};  ///< of liquids that the laboratory has not poured yet

  double wait_s() const { return 60.0 * wait_min; }

  /// Of work at the bench: 5 for the sensor, 3 a pour, 1 a placement, and the waiting. A reckoning of ours: it orders
  /// plans, no more.
  double minutes() const;
};

/// Around what was measured: the bare desk, the empty cup, other fills, distances and laterals, new pours, clear water
/// and an opaque liquid where there was none, and the same pour again half an hour later.
std::vector<MeasurementPlan> possible_plans(const Measurement& measurement);

/// The evidence that a plan would give, with these effects as candidates. Each session is set up anew.
Design design_of(const MeasurementPlan& plan, const Measurement& measurement, const std::vector<std::string>& effects,
                 const SharedJson& model_effects = SharedJson::array(), const std::string& file = "rig.json");

}  // namespace fathom
