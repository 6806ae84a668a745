#include "diagnosis/decision/unknown.h"

#include <fmt/format.h>

#include <cmath>

#include "core/dense.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

constexpr int kMostTerms = 3;

struct Term {
  std::string text;
  Eigen::VectorXd column;  ///< over all observations, 0 for other observables
};

/// Products of up to two factors, for each observable, of observations with a cup apart from bare desks.
std::vector<Term> term_library(const std::vector<Observation>& observations) {
  struct Shape {
    const char* text;
    double (*value)(const Factors&);
  };
  // Lengths in units of 100 mm, so that coefficients are of one size.
  static constexpr Shape kShapes[] = {
      {"", [](const Factors&) { return 1.0; }},
      {" · distance/100mm", [](const Factors& f) { return f.distance_mm / 100.0; }},
      {" · (distance/100mm)²", [](const Factors& f) { return std::pow(f.distance_mm / 100.0, 2.0); }},
      {" · fill/100mm", [](const Factors& f) { return f.fill_mm / 100.0; }},
      {" · (fill/100mm)²", [](const Factors& f) { return std::pow(f.fill_mm / 100.0, 2.0); }},
      {" · lateral/100mm", [](const Factors& f) { return f.lateral_mm / 100.0; }},
      {" · (lateral/100mm)²", [](const Factors& f) { return std::pow(f.lateral_mm / 100.0, 2.0); }},
      {" · fill·distance/(100mm)²", [](const Factors& f) { return f.fill_mm * f.distance_mm / 1e4; }},
      {" · time/100s", [](const Factors& f) { return f.time_s / 100.0; }},
  };
  std::vector<Term> library;
  const auto n = static_cast<Eigen::Index>(observations.size());
  // Parts of the cup are means over all of these.
  const Groups observables =
      group_by(observations, [](const Observation& o) { return o.factors.within_mm ? std::string() : o.observable; });
  const Groups liquids = group_by(observations, [](const Observation& o) {
    return o.factors.within_mm || o.is_of_session ? std::string() : o.observable + " of " + o.factors.liquid;
  });
  const auto add = [&](const std::string& where, const std::vector<Eigen::Index>& rows) {
    for (const Shape& shape : kShapes) {
      Eigen::VectorXd column = Eigen::VectorXd::Zero(n);
      for (const auto row : rows) column[row] = shape.value(observations[row].factors);
      library.push_back({where + shape.text, std::move(column)});
    }
  };
  for (const auto& rows : observables.members()) add(observations[rows[0]].observable, rows);
  for (const auto& rows : liquids.members())
    add(observations[rows[0]].observable + " of " + observations[rows[0]].factors.liquid, rows);
  return library;
}

/// Forward selection of terms until BIC stops improving.
std::string sparse_formula(const Evidence& evidence, const Covariance& covariance, Eigen::VectorXd residual,
                           const Eigen::MatrixXd& explained) {
  const std::vector<Term> library = term_library(evidence.observations);
  Eigen::MatrixXd columns(residual.size(), static_cast<Eigen::Index>(library.size()));
  for (std::size_t k = 0; k < library.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = library[k].column;
  columns = without(covariance.whiten(columns), explained);
  Eigen::MatrixXd left = columns;
  const Eigen::VectorXd data = residual, full = columns.colwise().squaredNorm();
  std::vector<Eigen::Index> chosen;
  while (chosen.size() < kMostTerms) {
    const Eigen::ArrayXd squares = left.colwise().squaredNorm().transpose();
    const Eigen::ArrayXd gains = (left.transpose() * residual).array().square() / squares.max(1e-300);
    Eigen::Index best = 0;
    const double gain = (squares > 0.01 * full.array()).select(gains, 0.0).maxCoeff(&best);
    if (gain < std::log(static_cast<double>(residual.size())) + 2.0 * std::log(static_cast<double>(library.size())))
      break;
    chosen.push_back(best);
    const Eigen::VectorXd direction = left.col(best).normalized();
    residual -= direction * direction.dot(residual);
    left -= direction * (direction.transpose() * left);
  }
  if (chosen.empty()) return {};
  const Eigen::MatrixXd X = columns(Eigen::all, chosen);
  const Eigen::VectorXd coefficients = (X.transpose() * X).ldlt().solve(X.transpose() * data);
  std::string formula;
  for (std::size_t k = 0; k < chosen.size(); ++k)
    formula += fmt::format("{}{:+.3g} in {}", k ? "; " : "", coefficients[static_cast<Eigen::Index>(k)],
                           library[chosen[k]].text);
  return formula;
}

/// Of the parts of cups the one that departs by most errors; `departures` of all observations, what is named apart.
void set_part(const Evidence& evidence, const Covariance& covariance, const Eigen::VectorXd& departures,
              UnknownShape& shape) {
  double most = 0.0;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Observation& o = evidence.observations[i];
    if (!o.factors.within_mm) continue;
    const double departure = departures[row];
    const double errors = std::abs(departure) / std::sqrt(covariance.total(row, row));
    if (errors <= most) continue;
    most = errors;
    shape.liquid = o.factors.liquid;
    shape.part = o.factors.region;
    shape.higher_mm = departure;
  }
}

}  // namespace

UnknownShape describe_unknown(const Evidence& evidence, const Covariance& covariance, const Problem& problem,
                              const Discrepancy& discrepancy, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& explained) {
  UnknownShape shape;
  shape.formula = sparse_formula(evidence, covariance, residual, explained);
  if (is_shape(discrepancy, residual)) set_part(evidence, covariance, covariance.factor.matrixL() * residual, shape);
  const Eigen::MatrixXd sensitivities = without(problem.sensitivities, explained);
  const Eigen::VectorXd map = smooth_map(discrepancy, residual, explained);
  shape.map.assign(map.data(), map.data() + map.size());
  const Eigen::VectorXd smoothed = covariance.whiten(map);
  for (std::size_t effect = 0; effect < problem.columns.size(); ++effect) {
    if (explained.cols() > 0 && sensitivities(Eigen::all, problem.columns[effect]).norm() <
                                    1e-3 * problem.sensitivities(Eigen::all, problem.columns[effect]).norm())
      continue;  // named already
    const Eigen::MatrixXd basis = orthonormal(sensitivities(Eigen::all, problem.columns[effect]));
    const double cosine = (basis.transpose() * smoothed).norm() / std::max(smoothed.norm(), 1e-300);
    if (cosine <= shape.similarity) continue;
    shape.similarity = cosine;
    shape.most_similar = evidence.candidates[effect].effect;
  }
  return shape;
}

}  // namespace fathom
