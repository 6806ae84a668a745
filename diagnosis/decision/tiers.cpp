#include "diagnosis/decision/tiers.h"

#include <algorithm>
#include <iterator>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

namespace {

bool holds_unknown(Verdict verdict) { return verdict == Verdict::unknown || verdict == Verdict::named_and_unknown; }

/// Whether the answer by all observations stands.
bool stands(Verdict by_all, Verdict by_deciding) {
  if (by_deciding == Verdict::insufficient || by_all == Verdict::named || by_all == Verdict::none) return true;
  if (holds_unknown(by_all)) return holds_unknown(by_deciding);
  return by_deciding != Verdict::none;
}

}  // namespace

std::vector<Eigen::Index> deciding_rows(const Evidence& evidence) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i)
    if (!evidence.observations[i].only_names) rows.push_back(static_cast<Eigen::Index>(i));
  return rows;
}

Evidence deciding_evidence(const Evidence& evidence, const std::vector<Eigen::Index>& rows) {
  Evidence part = evidence_of_rows(evidence, rows);
  std::erase_if(part.candidates, [](const Candidate& candidate) { return candidate.sensitivity.isZero(0.0); });
  return part;
}

Predict predict_rows(const Predict& predict, const std::vector<Eigen::Index>& rows) {
  return [predict, rows](const std::vector<EffectValue>& effects) -> Eigen::VectorXd { return predict(effects)(rows); };
}

Diagnosis joined_tiers(Diagnosis by_all, Diagnosis by_deciding, const Evidence& evidence,
                       const std::vector<Eigen::Index>& deciding) {
  if (stands(by_all.verdict, by_deciding.verdict)) return by_all;
  Residuals residuals = std::move(by_all.residuals);
  for (std::size_t i = 0; i < deciding.size(); ++i) {
    residuals.before[deciding[i]] = by_deciding.residuals.before[i];
    residuals.after[deciding[i]] = by_deciding.residuals.after[i];
    residuals.error[deciding[i]] = by_deciding.residuals.error[i];
  }
  by_deciding.residuals = std::move(residuals);
  if (!by_deciding.unknown.map.empty()) {
    std::vector<double> map(evidence.observations.size(), 0.0);
    for (std::size_t i = 0; i < deciding.size(); ++i) map[deciding[i]] = by_deciding.unknown.map[i];
    by_deciding.unknown.map = std::move(map);
  }
  const auto only_names = [&](const GapLocation& where) {
    return std::any_of(evidence.observations.begin(), evidence.observations.end(),
                       [&](const Observation& o) { return o.only_names && o.observable == where.observable; });
  };
  if (!by_all.ambiguity_set.empty() && !by_all.ambiguity_set.front().effects.empty() &&
      by_all.ambiguity_set.front().effects.back() != "unknown")
    by_deciding.departures.beside_effects = by_all.ambiguity_set.front().effects;
  std::copy_if(by_all.departures.where.begin(), by_all.departures.where.end(),
               std::back_inserter(by_deciding.departures.beside), only_names);
  return by_deciding;
}

}  // namespace fathom
