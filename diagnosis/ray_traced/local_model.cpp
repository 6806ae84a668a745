#include "diagnosis/ray_traced/local_model.h"

#include <algorithm>
#include <cmath>

namespace fathom {
namespace {

std::vector<Parameter> parameters_in(const Evidence& evidence, const std::vector<int>& effects) {
  std::vector<Parameter> all;
  for (const int effect : effects) {
    const std::vector<Parameter>& own = evidence.candidates[effect].parameters;
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

/// In prior scales.
double within_bounds(const Parameter& parameter, double departure) {
  if (parameter.lower >= parameter.upper) return departure;
  return std::clamp(departure, (parameter.lower - parameter.nominal) / parameter.prior_scale,
                    (parameter.upper - parameter.nominal) / parameter.prior_scale);
}

}  // namespace

std::vector<EffectValue> effect_values(const Evidence& evidence, const std::vector<int>& effects,
                                       const Eigen::VectorXd& parameters) {
  std::vector<EffectValue> values;
  Eigen::Index next = 0;
  for (const int effect : effects) {
    values.push_back({evidence.candidates[effect].effect, {}});
    for (const Parameter& parameter : evidence.candidates[effect].parameters)
      values.back().values.push_back(parameter.nominal +
                                     parameter.prior_scale * within_bounds(parameter, parameters[next++]));
  }
  return values;
}

Eigen::VectorXd parameters_of(const Evidence& evidence, const std::vector<int>& effects,
                              const std::vector<EffectValue>& values) {
  const std::vector<Parameter> parameters = parameters_in(evidence, effects);
  Eigen::VectorXd result(static_cast<Eigen::Index>(parameters.size()));
  Eigen::Index next = 0;
  for (const EffectValue& effect : values)
    for (const double value : effect.values) {
      result[next] = (value - parameters[next].nominal) / parameters[next].prior_scale;
      ++next;
    }
  return result;
}

LocalModel local_model(const Evidence& evidence, const std::vector<int>& effects, const Eigen::VectorXd& at,
                       const Predict& ask) {
  const std::vector<Parameter> parameters = parameters_in(evidence, effects);
  const auto asked = [&](const Eigen::VectorXd& x) { return ask(effect_values(evidence, effects, x)); };
  LocalModel model{effects, at, (0.5 * at.cwiseAbs()).cwiseMax(0.5), asked(at), {}};
  model.slopes.resize(model.there.size(), at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    Eigen::VectorXd low = at, high = at;
    low[k] = within_bounds(parameters[k], at[k] - model.reach[k]);
    high[k] = within_bounds(parameters[k], at[k] + model.reach[k]);
    model.slopes.col(k) = (asked(high) - asked(low)) / (high[k] - low[k]);
  }
  model.slopes = model.slopes.unaryExpr([](double slope) { return std::isfinite(slope) ? slope : 0.0; });
  return model;
}

}  // namespace fathom
