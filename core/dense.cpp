#include "core/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace fathom {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd pivoted_cholesky(Eigen::VectorXd variances, const std::function<Eigen::VectorXd(Eigen::Index)>& column,
                                 const Eigen::VectorXd& enough, Eigen::Index most) {
  Eigen::MatrixXd factor(variances.size(), std::min(variances.size(), most));
  Eigen::Index rank = 0;
  for (; rank < factor.cols(); ++rank) {
    Eigen::Index pivot = 0;
    if ((variances.array() / enough.array()).maxCoeff(&pivot) < 1.0 || variances[pivot] <= 0.0) break;
    factor.col(rank) = column(pivot) - factor.leftCols(rank) * factor.row(pivot).head(rank).transpose();
    factor.col(rank) /= std::sqrt(variances[pivot]);
    variances -= factor.col(rank).cwiseAbs2();
  }
  return factor.leftCols(rank);
}

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return columns;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns.rows(), columns.cols());
  qr.setThreshold(1e-8);
  qr.compute(columns);
  if (qr.rank() == 0) return Eigen::MatrixXd(columns.rows(), 0);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  const Eigen::MatrixXd all = qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.rows());
  return all.rightCols(columns.rows() - columns.cols());
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  return matrix.completeOrthogonalDecomposition().pseudoInverse();
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data) {
  return columns.colPivHouseholderQr().solve(data);
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& data) {
  return columns.colPivHouseholderQr().solve(data);
}

}  // namespace fathom
