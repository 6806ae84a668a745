// How the observations of a campaign change with one quantity, by differences between two set-ups.
#pragma once

#include "diagnosis/predict/predictor.h"

namespace fathom {

/// Indices of the predictor's conditions.
std::vector<std::size_t> conditions_where(const Predictor& predictor, const std::function<bool(const Factors&)>& is);

/// Those that an effect (named as by EffectName) can change: of one of liquids, the ones with a liquid, or with its
/// own.
std::vector<std::size_t> conditions_touched(const Predictor& predictor, const Effect& effect,
                                            const std::string& liquid);

/// Change per unit of every observation between the set-ups with `low` and `high` of a quantity, in those conditions;
/// the same rays look at both. 0 elsewhere, and where either sees nothing.
Eigen::VectorXd slope(const Predictor& predictor, const std::function<Change(double)>& at, double low, double high,
                      const std::vector<std::size_t>& conditions);

}  // namespace fathom
