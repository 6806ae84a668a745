#include "diagnosis/unit/view_sums.h"

#include <algorithm>
#include <cmath>

namespace fathom {
namespace {

constexpr int kOfPlane = 3;
constexpr int kColumnsOfCells = static_cast<int>(640.0 / kBiasCell_px);
constexpr double kFullCell = kBiasCell_px * kBiasCell_px;

/// 1, column, row; then a step of 1 between each two columns of cells.
Eigen::RowVectorXd own_of(const BiasCell& cell, bool with_steps) {
  Eigen::RowVectorXd own(kOfPlane + (with_steps ? kColumnsOfCells - 1 : 0));
  own.head(kOfPlane) << 1.0, cell.column_px / 320.0 - 1.0, cell.row_px / 240.0 - 1.0;
  for (Eigen::Index i = kOfPlane; i < own.size(); ++i)
    own[i] = cell.column_px > kBiasCell_px * static_cast<double>(i - kOfPlane + 1) ? 0.5 : -0.5;
  return own;
}

}  // namespace

ViewSums::ViewSums(const Cosines& cosines, std::span<const BiasView> views, const BiasPrior& prior)
    : cosines_(cosines), noise_(prior.cell_px * prior.cell_px), steps_(prior.columns_px * prior.columns_px) {
  std::map<double, int> rows;
  for (const BiasView& view : views)
    for (const BiasCell& cell : view.cells) rows.emplace(cell.row_px, 0);
  down_.resize(cosines.down(), static_cast<Eigen::Index>(rows.size()));
  int next = 0;
  for (auto& [row_px, number] : rows) {
    down_.col(next) = cosines.along_column(row_px);
    number = next++;
  }
  for (const BiasView& source : views) {
    View& view = views_.emplace_back();
    const auto cells = static_cast<Eigen::Index>(source.cells.size());
    view.state = source.state;
    states_ = std::max(states_, source.state + 1);
    cells_ += cells;
    view.weight.resize(cells);
    view.across.resize(2 * cosines.across(), cells);
    view.own.resize(cells, own_of({}, steps_ > 0.0).size());
    for (Eigen::Index i = 0; i < cells; ++i) {
      const BiasCell& cell = source.cells[i];
      view.weight[i] = cell.pixels / kFullCell;
      view.row.push_back(rows.at(cell.row_px));
      view.across.col(i) << cosines.along_row(cell.column_px - cell.nearer_px), cosines.along_row(cell.column_px);
      view.own.row(i) = own_of(cell, steps_ > 0.0);
    }
    const Eigen::MatrixXd weighted = view.weight.asDiagonal() * view.own;
    view.own_gram = view.own.transpose() * weighted;
    view.own_projected.resize(2 * cosines.size(), view.own.cols());
    for (Eigen::Index i = 0; i < view.own.cols(); ++i)
      view.own_projected.col(i) = projected(views_.size() - 1, weighted.col(i));
    Eigen::MatrixXd known = view.own_gram;
    known.diagonal().head(kOfPlane).array() += 1e-9;  // a view of fewer than three cells has no plane
    if (steps_ > 0.0) known.diagonal().tail(known.rows() - kOfPlane).array() += noise_ / steps_;
    view.eliminated.compute(known);
  }
}

Eigen::VectorXd ViewSums::from_rows(const Eigen::MatrixXd& sums) const {
  const Eigen::MatrixXd of_waves = sums * down_.transpose();
  const int half = cosines_.size(), across = cosines_.across();
  Eigen::VectorXd result(2 * half);
  for (int k = 0; k < half; ++k) {
    const auto& [i, j] = cosines_.waves()[k];
    result[k] = of_waves(i, j);
    result[half + k] = of_waves(across + i, j);
  }
  return result;
}

Eigen::VectorXd ViewSums::projected(std::size_t number, const Eigen::VectorXd& values) const {
  const View& view = views_[number];
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(2 * cosines_.across(), down_.cols());
  for (Eigen::Index i = 0; i < values.size(); ++i) sums.col(view.row[i]) += values[i] * view.across.col(i);
  return from_rows(sums);
}

Eigen::VectorXd ViewSums::field(std::size_t number, const Eigen::VectorXd& factors) const {
  const View& view = views_[number];
  const int half = cosines_.size(), across = cosines_.across();
  Eigen::MatrixXd of_waves = Eigen::MatrixXd::Zero(2 * across, cosines_.down());
  for (int k = 0; k < half; ++k) {
    const auto& [i, j] = cosines_.waves()[k];
    of_waves(i, j) = factors[k];
    of_waves(across + i, j) = factors[half + k];
  }
  const Eigen::MatrixXd along_rows = of_waves * down_;
  Eigen::VectorXd values(view.across.cols());
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = along_rows.col(view.row[i]).dot(view.across.col(i));
  return values;
}

Eigen::VectorXd ViewSums::whitened(std::size_t number, const Eigen::VectorXd& values) const {
  const View& view = views_[number];
  const Eigen::VectorXd weighted = view.weight.cwiseProduct(values);
  const Eigen::VectorXd own = view.eliminated.solve(view.own.transpose() * weighted);
  return (weighted - view.weight.cwiseProduct(view.own * own)) / noise_;
}

Eigen::MatrixXd ViewSums::gram(int state, int first, int count) const {
  const int half = cosines_.size(), across = cosines_.across();
  std::vector<Eigen::MatrixXd> of_rows(down_.cols(), Eigen::MatrixXd::Zero(2 * across, 2 * across));
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
  for (const View& view : views_) {
    if (view.state != state) continue;
    for (Eigen::Index i = 0; i < view.weight.size(); ++i)
      of_rows[view.row[i]].selfadjointView<Eigen::Lower>().rankUpdate(view.across.col(i), view.weight[i]);
    const Eigen::MatrixXd taken_out =
        view.eliminated.matrixL().solve(view.own_projected.middleRows(first, count).transpose());
    gram.selfadjointView<Eigen::Lower>().rankUpdate(taken_out.transpose(), -1.0);
  }
  for (Eigen::MatrixXd& row : of_rows) row = row.selfadjointView<Eigen::Lower>();
  // Cosines are products, so rows of cells are summed first, then across rows.
  const auto& waves = cosines_.waves();
  const auto wave = [&](int factor) {
    return factor < half ? waves[factor].first : across + waves[factor - half].first;
  };
  for (int b = first; b < first + count; ++b)
    for (int a = b; a < first + count; ++a) {
      const int down_a = waves[a % half].second, down_b = waves[b % half].second;
      double sum = 0.0;
      for (Eigen::Index row = 0; row < down_.cols(); ++row)
        sum += down_(down_a, row) * down_(down_b, row) * of_rows[row](wave(a), wave(b));
      gram(a - first, b - first) += sum;
    }
  gram = gram.selfadjointView<Eigen::Lower>();
  return gram / noise_;
}

Eigen::MatrixXd ViewSums::planes(std::optional<int> state) const {
  Eigen::MatrixXd planes = Eigen::MatrixXd::Zero(2 * cosines_.size(), kOfPlane);
  double weight = 1e-12;
  for (const View& view : views_) {
    if (state && view.state != *state) continue;
    planes += view.own_projected.leftCols(kOfPlane);
    weight += view.weight.sum();
  }
  return planes / weight;
}

Eigen::MatrixXd ViewSums::steps(std::size_t number) const {
  const View& view = views_[number];
  return view.own.rightCols(view.own.cols() - kOfPlane);
}

Eigen::MatrixXd ViewSums::projected_steps(std::size_t number) const {
  const View& view = views_[number];
  const Eigen::Index steps = view.own.cols() - kOfPlane;
  const Eigen::MatrixXd own = view.eliminated.solve(view.own_gram.rightCols(steps));
  return (view.own_projected.rightCols(steps) - view.own_projected * own) / noise_;
}

Eigen::MatrixXd ViewSums::whitened_steps(std::size_t number) const {
  const View& view = views_[number];
  const Eigen::Index steps = view.own.cols() - kOfPlane;
  const Eigen::MatrixXd gram = view.own_gram.rightCols(steps);
  return (gram - view.own_gram * view.eliminated.solve(gram)).bottomRows(steps) / noise_;
}

}  // namespace fathom
