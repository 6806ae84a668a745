// Decompositions of matrices of any size, compiled once: Eigen's own take 7 to 10 s in every file that asks for one.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace fathom {

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< columns
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// F (n × r) with F Fᵀ a covariance, as long as some variance is larger than what is enough there, and of at most so
/// many columns: pivoted Cholesky (Harbrecht, Peters & Schneider 2012). `column(i)` is the covariance's i-th.
Eigen::MatrixXd pivoted_cholesky(Eigen::VectorXd variances, const std::function<Eigen::VectorXd(Eigen::Index)>& column,
                                 const Eigen::VectorXd& enough, Eigen::Index most);

/// Orthonormal columns that span these; what adds less than 1e-8 of the largest is rounding.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// Orthonormal columns that span all that is at right angles to these, which are independent.
Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& columns);

/// Moore and Penrose's, which is the inverse where there is one.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

/// The parameters with which the columns come nearest to the data; of several data side by side, a column for each.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data);
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& data);

}  // namespace fathom
