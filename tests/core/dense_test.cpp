#include "core/dense.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fathom {
namespace {

/// Of a smooth process at so many points, a tenth of its length apart.
Eigen::MatrixXd smooth_covariance(Eigen::Index points) {
  return Eigen::MatrixXd::NullaryExpr(points, points, [](Eigen::Index i, Eigen::Index j) {
    const double apart = 0.1 * static_cast<double>(i - j);
    return std::exp(-0.5 * apart * apart);
  });
}

Eigen::MatrixXd factor_of(const Eigen::MatrixXd& covariance, double enough, Eigen::Index most) {
  return pivoted_cholesky(
      covariance.diagonal(), [&](Eigen::Index i) -> Eigen::VectorXd { return covariance.col(i); },
      Eigen::VectorXd::Constant(covariance.cols(), enough), most);
}

TEST(PivotedCholesky, LeavesNoMoreThanIsEnough) {
  const Eigen::MatrixXd covariance = smooth_covariance(100);
  const Eigen::MatrixXd factor = factor_of(covariance, 1e-4, 100);
  EXPECT_LT(factor.cols(), 30);
  const Eigen::MatrixXd left = covariance - factor * factor.transpose();
  EXPECT_LT(left.diagonal().maxCoeff(), 1e-4);
  EXPECT_GT(left.diagonal().minCoeff(), -1e-12);
  EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-4);  // covariances are no larger than variances
}

TEST(PivotedCholesky, IsExactWhereAllIsWanted) {
  const Eigen::MatrixXd covariance = smooth_covariance(8) + 0.1 * Eigen::MatrixXd::Identity(8, 8);
  const Eigen::MatrixXd factor = factor_of(covariance, 1e-12, 8);
  EXPECT_LT((factor * factor.transpose() - covariance).norm(), 1e-12);
}

TEST(PivotedCholesky, EndsWhereNothingVaries) {
  EXPECT_EQ(factor_of(Eigen::MatrixXd::Zero(5, 5), 0.0, 5).cols(), 0);
  EXPECT_EQ(factor_of(smooth_covariance(50), 1e-12, 3).cols(), 3);
}

}  // namespace
}  // namespace fathom
