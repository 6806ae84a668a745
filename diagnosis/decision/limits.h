// What could still hide: how large each effect may be unseen, and which effects hide behind each other.
#pragma once

#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

/// For every parameter of every candidate outside `named`, fitted beside the named ones (`residual` is what they leave,
/// `explained` their orthonormal span): |estimate| + 1.96 standard errors, and the departure that raises an alarm half
/// of the time.
std::vector<UpperLimit> upper_limits(const Evidence& evidence, const Problem& problem, const std::vector<int>& named,
                                     const Eigen::VectorXd& residual, const Eigen::MatrixXd& explained);

/// For every parameter of every candidate that the observations see.
std::vector<SizeError> size_errors(const Evidence& evidence, const Problem& problem);

/// Pairs of candidates whose sensitivities differ by less than 15°, closest first.
std::vector<ConfusablePair> confusable_pairs(const Evidence& evidence, const Problem& problem);

/// Combinations of at least three typical departures that the observations see at less than a tenth of one's strength.
std::vector<NearNullDirection> near_null_directions(const Evidence& evidence, const Problem& problem);

}  // namespace fathom
