#include "diagnosis/statistics/evidence.h"

namespace fathom {

Evidence evidence_of_rows(const Evidence& evidence, const std::vector<Eigen::Index>& rows) {
  Evidence part = evidence;
  part.observations.clear();
  for (const Eigen::Index row : rows) part.observations.push_back(evidence.observations[row]);
  part.predicted = evidence.predicted(rows).eval();
  if (evidence.numerical_sd.size() > 0) part.numerical_sd = evidence.numerical_sd(rows).eval();
  for (Nuisance& nuisance : part.nuisances) nuisance.sensitivity = nuisance.sensitivity(rows).eval();
  for (Candidate& candidate : part.candidates) {
    candidate.sensitivity = candidate.sensitivity(rows, Eigen::all).eval();
    Eigen::MatrixXd& errors = candidate.leeway.columns;
    if (errors.cols() > 0) errors = errors(rows, Eigen::all).eval();
  }
  for (std::size_t i = 0; i < evidence.shared_errors.size(); ++i) {
    std::vector<int>& group_of = part.shared_errors[i].group_of;
    group_of.clear();
    for (const Eigen::Index row : rows) group_of.push_back(evidence.shared_errors[i].group_of[row]);
  }
  return part;
}

}  // namespace fathom
