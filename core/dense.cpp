#include "core/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace fathom {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data) {
  return columns.colPivHouseholderQr().solve(data);
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& data) {
  return columns.colPivHouseholderQr().solve(data);
}

}  // namespace fathom
