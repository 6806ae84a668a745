#include "diagnosis/statistics/mean_space.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/dense.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

constexpr Eigen::Index kFewestReplicates = 8;

/// Orthonormal columns; what is already in their span is not added again.
class Span {
 public:
  Span(Eigen::Index rows, Eigen::Index most) : columns_(rows, most) {}

  void add(Eigen::VectorXd column) {
    const double before = column.norm();
    if (count_ == columns_.cols() || before == 0.0) return;
    for (int twice = 0; twice < 2; ++twice)  // for orthogonality to the last digit
      column -= columns_.leftCols(count_) * (columns_.leftCols(count_).transpose() * column);
    if (column.norm() < 1e-6 * before) return;
    columns_.col(count_++) = column.normalized();
  }

  Eigen::MatrixXd complement() const { return orthogonal_complement(columns_.leftCols(count_)); }

 private:
  Eigen::MatrixXd columns_;
  Eigen::Index count_ = 0;
};

std::vector<Observation> at(const std::vector<Observation>& observations, const std::vector<Eigen::Index>& rows) {
  std::vector<Observation> result;
  for (const auto row : rows) result.push_back(observations[row]);
  return result;
}

Eigen::MatrixXd indicators(const Groups& groups) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(groups.of.size()), groups.count);
  for (std::size_t i = 0; i < groups.of.size(); ++i)
    if (groups.of[i] >= 0) result(static_cast<Eigen::Index>(i), groups.of[i]) = 1.0;
  return result;
}

/// Powers of fill, distance and lateral up to the second degree, each from −1 to 1, the constant first.
Eigen::MatrixXd polynomials(const std::vector<Observation>& observations) {
  const auto n = static_cast<Eigen::Index>(observations.size());
  const Eigen::MatrixXd x = 2.0 * places_in_ranges(observations).array() - 1.0;
  constexpr std::array<std::array<int, 2>, 6> kProducts{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
  Eigen::MatrixXd result(n, 10);
  result << Eigen::VectorXd::Ones(n), x, Eigen::MatrixXd::Zero(n, 6);
  for (Eigen::Index k = 0; k < 6; ++k) result.col(4 + k) = x.col(kProducts[k][0]).cwiseProduct(x.col(kProducts[k][1]));
  return result;
}

/// A parabola over time.
void add_parabola(const std::vector<Observation>& observations, double Factors::*time, Span& means) {
  Eigen::VectorXd shares(static_cast<Eigen::Index>(observations.size()));
  for (Eigen::Index i = 0; i < shares.size(); ++i) shares[i] = observations[i].factors.*time;
  shares /= std::max(shares.maxCoeff(), 1e-12);
  means.add(shares);
  means.add(shares.cwiseAbs2());
}

/// What goes on while a pour stands and as sessions do, whether a candidate says so or not. Pours follow a session's
/// time as well: it is left to them where too few would be left to say how they scatter.
void add_drift(const std::vector<Observation>& observations, Span& means) {
  constexpr int kFewestFreePours = 8;
  add_parabola(observations, &Factors::stood_s, means);
  const Groups fillings = group_by(observations, [](const Observation& o) {
    return pour_key(o).empty() ? "" : fmt::format("{}, {} mm", o.factors.liquid, o.factors.fill_mm);
  });
  if (group_by(observations, pour_key).count - fillings.count >= kFewestFreePours)
    add_parabola(observations, &Factors::time_s, means);
}

/// Of all candidates, one after the other.
Eigen::MatrixXd sensitivities_at(const Evidence& evidence, const std::vector<Eigen::Index>& rows) {
  Eigen::MatrixXd result(rows.size(), 0);
  for (const Candidate& candidate : evidence.candidates) {
    result.conservativeResize(Eigen::NoChange, result.cols() + candidate.sensitivity.cols());
    result.rightCols(candidate.sensitivity.cols()) = candidate.sensitivity(rows, Eigen::all);
  }
  return result;
}

/// The directions, most common first, of which hardly more than a twentieth of any column is left.
Eigen::MatrixXd common_directions(Eigen::MatrixXd columns) {
  constexpr double kLeft = 0.05;
  // Not colwise().normalized(), which makes NaN of a column of zeros; and no decomposition is one of nothing.
  for (auto column : columns.colwise()) column.normalize();
  if (columns.isZero(0.0)) return columns.leftCols(0);
  // The singular vectors by their squares, which is exact enough for directions as large as these.
  const SymmetricEigen squares = symmetric_eigen(columns.transpose() * columns);
  const Eigen::Index count = (squares.values.array() > kLeft * kLeft).count();
  Eigen::MatrixXd directions = columns * squares.vectors.rightCols(count).rowwise().reverse();
  directions.colwise().normalize();
  return directions;
}

/// What all fillings show at a place is no error of pours or placements: those differ from one to the next.
Groups places_of_fillings(const std::vector<Observation>& observations) {
  constexpr int kFewestFillings = 3;  // at a place
  Groups places = group_by(observations, [](const Observation& o) {
    return fmt::format("{}/({:g}, {:g})", o.factors.region, o.factors.lateral_mm, o.factors.distance_mm);
  });
  const std::vector<std::vector<Eigen::Index>> members = places.members();
  for (int& place : places.of)
    if (place >= 0 && members[place].size() < kFewestFillings) place = -1;
  return places;
}

/// Contrasts of some observations that neither places nor sensitivities (observations × any number, those that matter
/// most first) nor polynomials of each liquid and region make.
Eigen::MatrixXd smooth_contrasts(const std::vector<Observation>& observations, const Eigen::MatrixXd& sensitivities) {
  const auto n = static_cast<Eigen::Index>(observations.size());
  Span means(n, n / 2);
  const auto add_products = [&](const Eigen::MatrixXd& groups, const Eigen::MatrixXd& shapes) {
    for (Eigen::Index s = 0; s < shapes.cols(); ++s)
      for (Eigen::Index g = 0; g < groups.cols(); ++g) means.add(groups.col(g).cwiseProduct(shapes.col(s)));
  };
  const Eigen::MatrixXd shapes = polynomials(observations);
  add_products(indicators(group_by(observations, [](const Observation& o) { return o.factors.region; })),
               shapes.leftCols(1));
  add_products(indicators(places_of_fillings(observations)), shapes.leftCols(1));
  for (Eigen::Index k = 0; k < sensitivities.cols(); ++k) means.add(sensitivities.col(k));
  add_products(indicators(group_by(observations, [](const Observation& o) { return level(o, "liquid"); })), shapes);
  add_products(indicators(group_by(observations,
                                   [](const Observation& o) { return o.factors.liquid + "/" + o.factors.region; })),
               shapes);
  return means.complement();
}

}  // namespace

Eigen::MatrixXd free_of_candidates(const Evidence& evidence, const Eigen::MatrixXd& weights) {
  Span means(weights.rows(), weights.rows());
  means.add(Eigen::VectorXd::Ones(weights.rows()));
  for (const Candidate& candidate : evidence.candidates)
    for (Eigen::Index k = 0; k < candidate.sensitivity.cols(); ++k) means.add(weights * candidate.sensitivity.col(k));
  return means.complement();
}

MeanSpace mean_space(const Evidence& evidence, const std::vector<Eigen::Index>& rows) {
  const std::vector<Observation> observations = at(evidence.observations, rows);
  const auto n = static_cast<Eigen::Index>(rows.size());
  const Groups cells = group_by(observations, cell_key);
  if (n - cells.count >= kFewestReplicates) {
    Span means(n, n - kFewestReplicates);
    const Eigen::MatrixXd columns = indicators(cells);
    for (Eigen::Index k = 0; k < columns.cols(); ++k) means.add(columns.col(k));
    add_drift(observations, means);
    return {means.complement(), true};
  }
  return {smooth_contrasts(observations, common_directions(sensitivities_at(evidence, rows))), false};
}

CellMeans cell_means(const Evidence& evidence, const std::vector<Eigen::Index>& rows) {
  const Groups cells = group_by(at(evidence.observations, rows), cell_key);
  CellMeans means{indicators(cells).transpose(), {}};
  std::vector<Eigen::Index> first;
  for (const auto& members : cells.members()) {
    means.over.row(static_cast<Eigen::Index>(first.size())) /= static_cast<double>(members.size());
    first.push_back(rows[members.front()]);
  }
  means.contrasts = smooth_contrasts(at(evidence.observations, first),
                                     common_directions(means.over * sensitivities_at(evidence, rows)));
  return means;
}

}  // namespace fathom
