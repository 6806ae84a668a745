#include "diagnosis/predict/physics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/estimate.h"
#include "core/json.h"
#include "core/units.h"
#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/predict/candidates.h"
#include "diagnosis/predict/liquid_motion.h"
#include "diagnosis/predict/model_errors.h"
#include "diagnosis/predict/nuisances.h"
#include "diagnosis/predict/predictable.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

/// Which of the predictor's observations it predicts, and not of a region near a shadow.
std::vector<bool> are_predicted(const Predictor& predictor) {
  const Eigen::VectorXd nominal = predictor.predict({});
  std::vector<bool> are = predictor.near_shadows();
  for (std::size_t row = 0; row < are.size(); ++row)
    are[row] = !are[row] && std::isfinite(nominal[static_cast<Eigen::Index>(row)]);
  return are;
}

/// Whether somebody reduced all heights, as a table has them, by whatever form; those of clouds are the program's own.
bool are_reduced(const std::vector<Observation>& observations) {
  return std::none_of(observations.begin(), observations.end(), [](const Observation& o) {
    return o.observable == "height_mm" && o.factors.region != kWholeInterior;
  });
}

/// To the heights of regions, what shares of theirs stray.
void tell_heights_of_strays(std::vector<Observation>& observations) {
  const auto key = [](const Observation& o) { return std::pair(placement_key(o), o.factors.region); };
  std::map<std::pair<std::string, std::string>, double> shares;
  for (const Observation& o : observations)
    if (o.observable == "stray_share") shares[key(o)] = o.value;
  for (Observation& o : observations)
    if (const auto share = shares.find(key(o)); o.observable == "height_mm" && share != shares.end())
      o.stray_share = share->second;
}

/// Keeps the shares of strays only of liquids that one sees through and of which, at one fill, more stray than a device
/// matches wrongly. In liquids that scatter what strays is the matcher's. That nothing strays says nothing against
/// waves either: windows take more of a wave together than a ray does.
void keep_many_strays(const std::vector<Observation>& observations, const std::vector<bool>& is_clear,
                      std::vector<bool>& kept) {
  constexpr double kFew = 0.05;                          // a device matches a hundredth wrongly, of dark bottoms more
  std::map<std::string, std::map<double, Mean>> shares;  // of each liquid, by fill
  const auto is_share = [&](std::size_t row) { return kept[row] && observations[row].observable == "stray_share"; };
  for (std::size_t row = 0; row < kept.size(); ++row)
    if (const Factors& f = observations[row].factors; is_share(row) && is_clear[row])
      shares[f.liquid][f.fill_mm].add(observations[row].value);
  for (std::size_t row = 0; row < kept.size(); ++row)
    if (is_share(row))
      kept[row] = is_clear[row] && std::ranges::any_of(shares[observations[row].factors.liquid], [](const auto& fill) {
                    return fill.second.estimate().value > kFew;
                  });
}

/// Which rows are of a liquid that the model sees through, only of one with that label where there is one.
std::vector<bool> see_through(const Predictor& predictor, const std::string& liquid, std::size_t rows) {
  std::vector<bool> see(rows, false);
  for (const Condition& condition : predictor.conditions()) {
    const std::optional<CupOptics>& cup = condition.nominal->view.cup;
    if (!cup || cup->layers.empty() || cup->layers.back().opaque) continue;
    if (!liquid.empty() && condition.factors.liquid != liquid) continue;
    for (const std::size_t row : condition.rows) see[row] = true;
  }
  return see;
}

/// Shapes of what is seen in cups, and of which parts of them the heights of regions are means.
void add_shapes(const Measurement& measurement, Predictor& predictor, Evidence& evidence) {
  const double radius = interior_radius(measurement.rig.cup);
  std::vector<ContentSight> sights = predictor.content_sights(measurement.observations);
  for (const ContentSight& sight : sights)
    for (const std::size_t row : predictor.conditions()[sight.condition].rows)
      if (Observation& o = evidence.observations[row]; o.observable == "height_mm")
        o.parts = parts_of_region(o.factors.region, sight.cells, radius);
  for (ContentShape& shape : content_shapes(std::move(sights), radius)) {
    evidence.observations.push_back(shape.observation);
    predictor.add(std::move(shape));
  }
}

std::vector<OddDesk> odd_desks(const Measurement& measurement) {
  std::vector<OddDesk> result;
  if (!measurement.unit || measurement.frames.empty()) return result;  // nothing, or what is planned
  const LaboratoryRig& rig = measurement.rig;
  const double of_inverse = rig.focal_px * rig.baseline_m;  // [px m] disparity times depth
  const auto mm_per_px = [&](double nearer_px) {            // above the desk
    const double depth_m = of_inverse / (nearer_px + of_inverse / kReferenceDistance_m);
    return mm_from_metres(depth_m * rig.height_m / of_inverse);
  };
  for (const DeskDifference& found : measurement.unit->session_differences()) {
    const double scale = mm_per_px(found.nearer_px);
    const Eigen::Vector2d last_px = found.first_px + found.size_px;
    result.push_back({found.session,
                      fmt::format("in columns {:.0f} to {:.0f} and rows {:.0f} to {:.0f} of the image",
                                  found.first_px.x(), last_px.x(), found.first_px.y(), last_px.y()),
                      scale * found.bias_px, scale * found.sigma_px, found.p()});
  }
  if (const std::optional<LocalBias> found = measurement.unit->local_bias()) {
    const double scale = mm_per_px(found->nearer_px);
    result.push_back({std::nullopt,
                      fmt::format("within {:.0f} px of column {:.0f} and row {:.0f} of the image",
                                  1.5 * found->reach_px, found->middle_px.x(), found->middle_px.y()),
                      scale * found->bias_px, scale * found->sigma_px, found->p()});
  }
  return result;
}

}  // namespace

Physics physics_of(const Measurement& measurement, const SharedJson& model_effects, const std::string& file,
                   const std::vector<std::string>& only, bool quiet) {
  Physics physics;
  Evidence& evidence = physics.evidence;
  evidence.mistakes = measurement.mistakes;
  const LaboratoryRig& rig = measurement.rig;
  evidence.stated = {mm_from_metres(rig.session_m), deg_from_radians(rig.session_rad), mm_from_metres(rig.fill_sigma_m),
                     mm_from_metres(rig.placement_sigma_m)};
  evidence.is_calibrated = rig.unit.map != nullptr;
  evidence.odd_desks = odd_desks(measurement);
  std::vector<Observation> observations = predictable(measurement.observations);
  tell_heights_of_strays(observations);
  const auto predictor = std::make_shared<Predictor>(measurement.rig, observations, model_effects, file,
                                                     measurement.unit, measurement.desk_sights);
  std::vector<bool> kept = are_predicted(*predictor);
  keep_many_strays(observations, see_through(*predictor, "", observations.size()), kept);
  for (std::size_t row = 0; row < kept.size(); ++row)
    if (kept[row]) evidence.observations.push_back(observations[row]);
  predictor->keep(kept);
  for (Observation& motion :
       liquid_motion(evidence.observations, see_through(*predictor, "", evidence.observations.size()))) {
    predictor->add(motion);
    evidence.observations.push_back(std::move(motion));
  }
  add_shapes(measurement, *predictor, evidence);
  const Nuisance windows = usual_windows(*predictor);
  const Eigen::VectorXd middle = windows.sigma * windows.sensitivity;
  evidence.predicted = predictor->predict({}) + middle;
  evidence.numerical_sd = numerical_errors(evidence.observations);
  evidence.nuisances = nuisances_of(*predictor);
  for (Nuisance& nuisance : unit_nuisances(*predictor, evidence.observations))
    evidence.nuisances.push_back(std::move(nuisance));
  evidence.nuisances.push_back(windows);
  if (Nuisance response = brightness_response(evidence.observations, evidence.predicted);
      !response.sensitivity.isZero())
    evidence.nuisances.push_back(std::move(response));
  evidence.shared_errors = model_errors(evidence.observations, measurement.rig);
  Candidates candidates = candidates_of(*predictor, only, quiet);
  evidence.candidates = std::move(candidates.all);
  if (only.empty() && !are_reduced(evidence.observations))
    std::erase_if(evidence.candidates, [](const Candidate& one) { return one.effect == "skew_approximation"; });
  for (Candidate& candidate : evidence.candidates) {
    const EffectName name = effect_name(candidate.effect);
    candidate.leeway = effect_errors(name.id, evidence.observations,
                                     see_through(*predictor, name.liquid, evidence.observations.size()));
  }
  physics.unseen = std::move(candidates.unseen);
  physics.predictor = predictor;
  physics.predict = [predictor, middle, nominal = evidence.predicted](const std::vector<EffectValue>& effects) {
    Eigen::VectorXd values = predictor->predict(switch_on(effects)) + left_to_usual_windows(effects) * middle;
    for (Eigen::Index row = 0; row < values.size(); ++row)
      if (!std::isfinite(values[row])) values[row] = nominal[row];
    return values;
  };
  return physics;
}

}  // namespace fathom
