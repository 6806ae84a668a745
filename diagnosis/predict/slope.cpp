#include "diagnosis/predict/slope.h"

#include "diagnosis/statistics/groups.h"

#include <cmath>

namespace fathom {

std::vector<std::size_t> conditions_where(const Predictor& predictor, const std::function<bool(const Factors&)>& is) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < predictor.conditions().size(); ++i)
    if (is(predictor.conditions()[i].factors)) found.push_back(i);
  return found;
}

std::vector<std::size_t> conditions_touched(const Predictor& predictor, const Effect& effect,
                                            const std::string& liquid) {
  return conditions_where(predictor, [&](const Factors& f) {
    return liquid.empty() ? !effect.of_liquids || has_liquid(f) : f.liquid == liquid;
  });
}

Eigen::VectorXd slope(const Predictor& predictor, const std::function<Change(double)>& at, double low, double high,
                      const std::vector<std::size_t>& conditions) {
  Eigen::VectorXd difference =
      (predictor.predict(at(high), conditions) - predictor.predict(at(low), conditions)) / (high - low);
  for (double& value : difference)
    if (!std::isfinite(value)) value = 0.0;
  return difference;
}

}  // namespace fathom
