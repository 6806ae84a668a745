// Normal equations of a unit's bias over views: every view's plane and steps of columns taken out of them.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/unit/bias_prior.h"
#include "diagnosis/unit/bias_view.h"
#include "diagnosis/unit/cosines.h"

namespace fathom {

/// Factors stand in the order: those of the frame of the reference, those of the camera's.
class ViewSums {
 public:
  /// Takes each view's plane out and, where the prior has steps of columns, these as well.
  ViewSums(const Cosines& cosines, std::span<const BiasView> views, const BiasPrior& prior);

  std::size_t views() const { return views_.size(); }
  int states() const { return states_; }
  int state_of(std::size_t view) const { return views_[view].state; }
  Eigen::Index cells() const { return cells_; }

  /// Φᵀ N⁻¹ Φ over the views of a state (kNoState: those without one), of `count` factors from `first` on. N: a view's
  /// own errors.
  Eigen::MatrixXd gram(int state, int first, int count) const;
  /// Φᵀ values of one view's cells.
  Eigen::VectorXd projected(std::size_t view, const Eigen::VectorXd& values) const;
  /// Φ factors, at the view's cells.
  Eigen::VectorXd field(std::size_t view, const Eigen::VectorXd& factors) const;
  /// N⁻¹ values.
  Eigen::VectorXd whitened(std::size_t view, const Eigen::VectorXd& values) const;
  /// Mean of the field times 1, column and row over all cells of a state's views, without one of all views: three
  /// columns.
  Eigen::MatrixXd planes(std::optional<int> state = {}) const;

  // For the prior.
  const Eigen::VectorXd& weight(std::size_t view) const { return views_[view].weight; }
  /// A view's steps of columns: values at its cells, and Φᵀ N⁻¹ of them.
  Eigen::MatrixXd steps(std::size_t view) const;
  Eigen::MatrixXd projected_steps(std::size_t view) const;
  /// stepsᵀ N⁻¹ steps.
  Eigen::MatrixXd whitened_steps(std::size_t view) const;

 private:
  struct View {
    int state;
    Eigen::VectorXd weight;                  ///< of each cell, 1 for a full one
    std::vector<int> row;                    ///< of each cell, in down_
    Eigen::MatrixXd across;                  ///< both frames' cosines along the row, a column a cell
    Eigen::MatrixXd own;                     ///< plane and steps, a row a cell
    Eigen::MatrixXd own_projected;           ///< Φᵀ W own
    Eigen::MatrixXd own_gram;                ///< ownᵀ W own
    Eigen::LLT<Eigen::MatrixXd> eliminated;  ///< of own_gram and what is thought of the steps
  };
  Eigen::VectorXd from_rows(const Eigen::MatrixXd& sums) const;

  Cosines cosines_;
  double noise_, steps_;  ///< [px²]
  int states_ = 0;
  Eigen::Index cells_ = 0;
  Eigen::MatrixXd down_;  ///< cosines along the columns, a column a row of cells
  std::vector<View> views_;
};

}  // namespace fathom
