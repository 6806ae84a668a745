#include "diagnosis/predict/nuisances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/units.h"
#include "diagnosis/measurement/cup_in_sight.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

const std::string kUnitBias = "the sensor's own bias";

/// Only those conditions' part of a sensitivity.
Eigen::VectorXd part_of(const Predictor& predictor, const Eigen::VectorXd& sensitivity,
                        const std::function<bool(const Factors&)>& is) {
  Eigen::VectorXd part = Eigen::VectorXd::Zero(sensitivity.size());
  for (const std::size_t i : conditions_where(predictor, is))
    for (const std::size_t row : predictor.conditions()[i].rows)
      part[static_cast<Eigen::Index>(row)] = sensitivity[static_cast<Eigen::Index>(row)];
  return part;
}

/// A sensor that is set up anew stands and looks a little otherwise: by as much as the note of its pose may be off
/// anyway. A campaign of one session is set up once; what is planned beside it is not that session,
/// but a later one.
void add_sessions(const Predictor& predictor, const Nuisance& pose, std::vector<Nuisance>& nuisances) {
  std::set<int> sessions;
  for (const Condition& condition : predictor.conditions()) sessions.insert(condition.factors.session);
  if (sessions == std::set{0}) return;
  for (const int session : sessions)
    nuisances.push_back(
        {fmt::format("{} of session {}", pose.name, session), pose.sigma,
         part_of(predictor, pose.sensitivity, [&](const Factors& factors) { return factors.session == session; }),
         pose.name + " of sessions"});
}

void add_rig(const Predictor& predictor, std::vector<Nuisance>& nuisances) {
  const std::map<std::string, double>& sigmas = predictor.model().laboratory.sigma;
  for (const RigValue& value : kRigValues) {
    const auto given = sigmas.find(value.key);
    const double sigma = given != sigmas.end() ? given->second : value.usual_sigma;
    if (sigma <= 0.0) continue;
    const auto at = [&](double x) { return switch_on({{value.effect, {x}}}); };
    const Nuisance nuisance{value.key, sigma, slope(predictor, at, -sigma, sigma, predictor.all_conditions())};
    nuisances.push_back(nuisance);
    if (value.is_pose) add_sessions(predictor, nuisance, nuisances);
  }
}

void add_fills(const Predictor& predictor, std::vector<Nuisance>& nuisances) {
  const double sigma_mm = mm_from_metres(predictor.model().laboratory.fill_sigma_m);
  if (sigma_mm <= 0.0) return;
  const auto at = [](double x) { return switch_on({{"fill_offset", {x}}}); };
  const Eigen::VectorXd all = slope(predictor, at, -sigma_mm, sigma_mm, conditions_where(predictor, has_liquid));
  std::set<std::string> pours;
  for (const Condition& condition : predictor.conditions())
    if (has_liquid(condition.factors)) pours.insert(pour_of(condition.factors));
  for (const std::string& pour : pours)
    nuisances.push_back({"fill of pour " + pour, sigma_mm,
                         part_of(predictor, all, [&](const Factors& f) { return pour_of(f) == pour; }), "fills"});
}

void add_places(const Predictor& predictor, std::vector<Nuisance>& nuisances) {
  const double sigma_mm = mm_from_metres(predictor.model().laboratory.placement_sigma_m);
  if (sigma_mm <= 0.0) return;
  const std::vector<std::size_t> with_cup = conditions_where(predictor, has_cup);
  for (int axis = 0; axis < 2; ++axis) {
    const auto along = [axis](double x) {
      return switch_on({{"cup_placement", axis == 0 ? std::vector{x, 0.0} : std::vector{0.0, x}}});
    };
    const Eigen::VectorXd all = slope(predictor, along, -sigma_mm, sigma_mm, with_cup);
    for (const std::size_t i : with_cup) {
      const Condition& condition = predictor.conditions()[i];
      Eigen::VectorXd own = Eigen::VectorXd::Zero(all.size());
      for (const std::size_t row : condition.rows)
        own[static_cast<Eigen::Index>(row)] = all[static_cast<Eigen::Index>(row)];
      nuisances.push_back({fmt::format("{} of placement {}/{}", axis == 0 ? "x" : "y", condition.factors.session,
                                       condition.factors.placement),
                           sigma_mm, std::move(own), "places of cups"});
    }
  }
}

}  // namespace

std::vector<Nuisance> nuisances_of(const Predictor& predictor) {
  std::vector<Nuisance> nuisances;
  add_rig(predictor, nuisances);
  add_fills(predictor, nuisances);
  add_places(predictor, nuisances);
  return nuisances;
}

std::vector<Nuisance> unit_nuisances(const Predictor& predictor, const std::vector<Observation>& observations) {
  std::vector<Nuisance> nuisances;
  for (Eigen::VectorXd& error : predictor.unit_errors())
    nuisances.push_back({fmt::format("{} {}", kUnitPattern, nuisances.size() + 1), 1.0, std::move(error), kUnitBias});
  std::map<std::pair<double, double>, Nuisance> places;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Factors& f = observations[i].factors;
    if (observations[i].observable != "height_mm" || f.region != kWholeInterior) continue;
    Nuisance& place = places[{f.distance_mm, f.lateral_mm}];
    if (place.name.empty())
      place = {fmt::format("bias of the unit at ({:g}, {:g}) mm", f.lateral_mm, f.distance_mm),
               kBias_px * height_per_px_mm({metres_from_mm(f.lateral_mm), metres_from_mm(f.distance_mm)},
                                           predictor.model().laboratory),
               Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observations.size())), kUnitBias};
    place.sensitivity[static_cast<Eigen::Index>(i)] = 1.0;
  }
  for (auto& [where, place] : places) nuisances.push_back(std::move(place));
  return nuisances;
}

Nuisance usual_windows(const Predictor& predictor) {
  constexpr double kWidth_px = kDeviceWindow_px - kNoWindow_px;
  const auto at = [](double x) { return switch_on({{"window_averaging", {x}}}); };
  return {"matching window", 0.5,
          kWidth_px * slope(predictor, at, kNoWindow_px, kDeviceWindow_px, predictor.all_conditions())};
}

double left_to_usual_windows(const std::vector<EffectValue>& effects) {
  for (const EffectValue& effect : effects)
    if (effect.effect == "window_averaging")
      return std::clamp((kDeviceWindow_px - effect.values[0]) / (kDeviceWindow_px - kNoWindow_px), 0.0, 1.0);
  return 1.0;
}

Nuisance brightness_response(const std::vector<Observation>& observations, const Eigen::VectorXd& predicted) {
  constexpr double kExponentSigma = 0.5;
  Nuisance response{"response of the brightness", kExponentSigma, Eigen::VectorXd::Zero(predicted.size())};
  for (std::size_t i = 0; i < observations.size(); ++i)
    if (const auto row = static_cast<Eigen::Index>(i); observations[i].observable == "log_brightness")
      response.sensitivity[row] = predicted[row];
  return response;
}

}  // namespace fathom
