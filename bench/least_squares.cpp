// usage: least_squares
// Bounded least squares of a handful of unknowns, as the screening solves a hundred thousand of: ours beside Ceres.
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <random>
#include <vector>

#include "diagnosis/statistics/box_least_squares.h"

namespace {

struct Bounded {
  Eigen::MatrixXd G;
  Eigen::VectorXd b, lower, upper;

  double objective(const Eigen::VectorXd& x) const { return 0.5 * x.dot(G * x) - b.dot(x); }
};

/// Sensitivities of correlated effects, and bounds that about half of the solutions touch.
std::vector<Bounded> drawn(int unknowns, int count) {
  std::mt19937_64 random(static_cast<std::uint64_t>(unknowns));
  std::normal_distribution<double> normal;
  const auto values = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }).eval();
  };
  std::vector<Bounded> result;
  for (int i = 0; i < count; ++i) {
    const Eigen::MatrixXd sensitivities = values(40, unknowns) + values(40, 1).replicate(1, unknowns);
    const Eigen::MatrixXd gram =
        sensitivities.transpose() * sensitivities + Eigen::MatrixXd::Identity(unknowns, unknowns);
    result.push_back({gram, sensitivities.transpose() * values(40, 1) * 10.0, -values(unknowns, 1).cwiseAbs(),
                      values(unknowns, 1).cwiseAbs()});
  }
  return result;
}

/// ½ |Lᵀ x − L⁻¹ b|², which is the objective but for a constant.
class Distance final : public ceres::CostFunction {
 public:
  explicit Distance(const Bounded& problem)
      : factor_(problem.G.llt().matrixU()), target_(problem.G.llt().matrixL().solve(problem.b)) {
    set_num_residuals(static_cast<int>(problem.b.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.b.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const auto size = target_.size();
    Eigen::Map<Eigen::VectorXd>(residuals, size) =
        factor_ * Eigen::Map<const Eigen::VectorXd>(parameters[0], size) - target_;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (jacobians && jacobians[0]) Eigen::Map<RowMajor>(jacobians[0], size, size) = factor_;
    return true;
  }

 private:
  Eigen::MatrixXd factor_;
  Eigen::VectorXd target_;
};

Eigen::VectorXd by_ceres(const Bounded& problem) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.b.size());
  ceres::Problem ceres;
  ceres.AddResidualBlock(new Distance(problem), nullptr, x.data());
  for (int k = 0; k < static_cast<int>(x.size()); ++k) {
    ceres.SetParameterLowerBound(x.data(), k, problem.lower[k]);
    ceres.SetParameterUpperBound(x.data(), k, problem.upper[k]);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  options.function_tolerance = options.parameter_tolerance = options.gradient_tolerance = 1e-10;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres, &summary);
  return x;
}

Eigen::VectorXd by_us(const Bounded& problem) {
  return fathom::box_least_squares(problem.G, problem.b, problem.lower, problem.upper);
}

template <class Solve>
std::pair<double, std::vector<Eigen::VectorXd>> timed(const std::vector<Bounded>& problems, Solve solve) {
  std::vector<Eigen::VectorXd> solutions(problems.size());
  const auto start = std::chrono::steady_clock::now();
  std::transform(problems.begin(), problems.end(), solutions.begin(), solve);
  const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
  return {taken.count() / static_cast<double>(problems.size()), std::move(solutions)};
}

}  // namespace

int main() {
  fmt::print("| unknowns | box_least_squares | Ceres | ratio | largest excess of ours | largest excess of Ceres |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (int unknowns = 1; unknowns <= 6; ++unknowns) {
    const std::vector<Bounded> problems = drawn(unknowns, 2000);
    const auto [ours_us, ours] = timed(problems, by_us);
    const auto [ceres_us, theirs] = timed(problems, by_ceres);
    double our_excess = 0.0, their_excess = 0.0;  // of the objective
    for (std::size_t i = 0; i < problems.size(); ++i) {
      const double difference = problems[i].objective(ours[i]) - problems[i].objective(theirs[i]);
      our_excess = std::max(our_excess, difference);
      their_excess = std::max(their_excess, -difference);
    }
    fmt::print("| {} | {:.2f} µs | {:.1f} µs | {:.0f} | {:.1g} | {:.1g} |\n", unknowns, ours_us, ceres_us,
               ceres_us / ours_us, our_excess, their_excess);
  }
}
