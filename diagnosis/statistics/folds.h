// Condition groups that have no part in each other's choices.
#pragma once

#include <cstdint>
#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

inline constexpr int kFolds = 6;
/// Share of an effect's information that makes a part of the data count.
inline constexpr double kInformative = 0.02;

/// The fold 0 … kFolds-1 of every observation. Whole pours go together where there are at least twice as many as folds,
/// else whole placements. They are ordered by liquid, fill, distance and lateral and dealt out in shuffled rounds, so
/// that every fold has something of everything.
std::vector<int> deal_folds(const std::vector<Observation>& observations, std::uint64_t seed);

/// Rows whose fold is (or is not) among some.
std::vector<Eigen::Index> rows_in(const std::vector<int>& folds, const std::vector<int>& wanted, bool is_in);

}  // namespace fathom
