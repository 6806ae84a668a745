// Errors that come with an explanation: what they cost it, and what they keep from being called in beside it.
#include "diagnosis/statistics/leeway.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "core/rng.h"
#include "diagnosis/decision/decide.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"
#include "tests/diagnosis/statistics/small_campaign.h"

namespace fathom {
namespace {

Eigen::MatrixXd normals(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Eigen::MatrixXd result(rows, columns);
  Rng rng(seed, 0);
  for (double& value : result.reshaped()) value = rng.normal();
  return result;
}

// Products of ten by ten numbers of size 1 to 10.
constexpr double kRounding = 1e-10;

TEST(Leeway, WhitensWhatItAdds) {
  Eigen::MatrixXd errors = normals(12, 4, 1);
  errors.col(3) = errors.col(0) - 2.0 * errors.col(1);  // errors that go together are fewer
  const Leeway leeway = leeway_of(errors);
  EXPECT_EQ(leeway.along.cols(), 3);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(12, 12), covariance = one + errors * errors.transpose();
  const Eigen::MatrixXd root = leeway.whiten(one);
  EXPECT_LT((root * covariance * root.transpose() - one).norm(), kRounding);
  EXPECT_NEAR(leeway.log_det, std::log(covariance.determinant()), kRounding);
}

TEST(Leeway, TakesTheShareOfAResidualThatIsLikeliest) {
  const Eigen::MatrixXd errors = normals(12, 4, 2);
  const Eigen::VectorXd residual = normals(12, 1, 3);
  const Eigen::MatrixXd with_prior = errors.transpose() * errors + Eigen::MatrixXd::Identity(4, 4);
  const Eigen::VectorXd likeliest = errors * with_prior.ldlt().solve(errors.transpose() * residual);
  EXPECT_LT((leeway_of(errors).share_in(residual) - likeliest).norm(), kRounding);
}

TEST(Leeway, IsNothingWithoutErrors) {
  const Eigen::VectorXd residual = normals(5, 1, 4);
  const Leeway none = leeway_of(Eigen::MatrixXd(5, 0));
  EXPECT_EQ(none.whiten(residual), residual);
  EXPECT_EQ(none.share_in(residual), Eigen::VectorXd::Zero(5));
  EXPECT_EQ(none.log_det, 0.0);
}

TEST(Leeway, GrowsWithWhatBringsItWhereItIsSaidTo) {
  const Eigen::MatrixXd errors = normals(12, 4, 5);
  const Leeway quarter = leeway_of(errors, 0.0).at(0.25), half_the_errors = leeway_of(0.5 * errors);
  EXPECT_LT((quarter.whiten(errors) - half_the_errors.whiten(errors)).norm(), kRounding);
  EXPECT_NEAR(quarter.log_det, half_the_errors.log_det, kRounding);
  EXPECT_EQ(leeway_of(errors).at(0.25).log_det, leeway_of(errors).log_det);
  const Leeway later = leeway_of(errors, 1.0);
  EXPECT_EQ(later.at(0.9).log_det, 0.0);
  EXPECT_EQ(later.at(0.9).whiten(errors), errors);
  EXPECT_NEAR(later.at(1.25).log_det, half_the_errors.log_det, kRounding);
}

/// Of each region of a liquid's surface at each place, 1 σ.
Eigen::MatrixXd holes(const World& world, double sigma_mm) {
  const std::vector<Observation>& observations = world.nominal().observations;
  const Groups groups = group_by(observations, [](const Observation& o) {
    return o.observable == "height_mm" ? condition_key(o) + o.factors.region : std::string();
  });
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(observations.size()), groups.count);
  for (std::size_t row = 0; row < observations.size(); ++row)
    if (groups.of[row] >= 0) errors(static_cast<Eigen::Index>(row), groups.of[row]) = sigma_mm;
  return errors;
}

std::vector<std::string> named(const World& world, const Evidence& evidence) {
  std::vector<std::string> names;
  for (const NamedEffect& effect : decide(evidence, world.predict()).effects) names.push_back(effect.name);
  return names;
}

TEST(Leeway, IsBroughtByWhatIsThereAlone) {
  const World world(small_design());
  Evidence evidence = world.measure({}, {}, 11);
  const int foam = world.candidate("foam"), tilt = world.candidate("surface_tilt");
  evidence.candidates[foam].leeway.columns = holes(world, 0.5);
  const Covariance covariance = estimate_covariance(evidence, measured_minus_predicted(evidence));
  const Problem problem = whitened_problem(evidence, covariance);
  std::vector<int> both{tilt, foam};
  std::sort(both.begin(), both.end());
  Eigen::VectorXd amounts = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(columns_of(problem, both).size()));
  EXPECT_GT(leeway_beside(problem, both, amounts).log_det, 0.0);
  const auto before = static_cast<Eigen::Index>(both[0] == foam ? 0 : problem.columns[tilt].size());
  amounts.segment(before, static_cast<Eigen::Index>(problem.columns[foam].size())).setZero();
  EXPECT_EQ(leeway_beside(problem, both, amounts).log_det, 0.0);
}

TEST(Leeway, KeepsATiltFromBeingCalledInForAFoamsHoles) {
  const World world(small_design());
  const std::vector<EffectValue> truth{world.at_strength("surface_tilt", 8.0, 1.0),
                                       world.at_strength("foam", 40.0, 1.0)};
  Evidence evidence = world.measure(truth, {}, 11);
  EXPECT_EQ(named(world, evidence), (std::vector<std::string>{"surface_tilt", "foam"}));
  // Holes that move each region by half a millimetre, four of its errors, may look like that as well.
  evidence.candidates[world.candidate("foam")].leeway.columns = holes(world, 0.5);
  EXPECT_EQ(named(world, evidence), std::vector<std::string>{"foam"});
}

// What is left open, too, has only the leeway of its size: an effect of which next to nothing is there explains
// nothing.
TEST(Leeway, IsThatOfASizeForWhatWasNotRefitted) {
  const World world(small_design());
  Evidence evidence =
      world.measure({world.at_strength("sensor_roll", 40.0, 1.0), world.at_strength("foam", 150.0, 1.0)}, {}, 11);
  OwnErrors& leeway = evidence.candidates[world.candidate("surface_tilt")].leeway;
  leeway.columns = holes(world, 5.0);
  leeway.grow_from = 2.0;
  EXPECT_EQ(named(world, evidence), (std::vector<std::string>{"sensor_roll", "foam"}));
}

TEST(Leeway, HidesNothingThatShowsElsewhere) {
  const World world(small_design());
  const Eigen::MatrixXd errors = holes(world, 0.5);
  const Eigen::VectorXd pattern = errors * normals(errors.cols(), 1, 5);
  Evidence evidence = world.measure(
      {world.at_strength("sensor_height", 15.0, 1.0), world.at_strength("foam", 60.0, 1.0)}, {}, 11, pattern);
  evidence.candidates[world.candidate("foam")].leeway.columns = errors;
  EXPECT_EQ(named(world, evidence), (std::vector<std::string>{"sensor_height", "foam"}));
}

}  // namespace
}  // namespace fathom
