#include "diagnosis/unit/local_bias.h"

#include <array>
#include <vector>

#include "diagnosis/unit/bias_learner.h"

namespace fathom {
namespace {

/// Wider ones are what biases are like; narrower ones are lost in a cell.
constexpr std::array kBumps_px{20.0, 30.0, 45.0};

/// Of each cell.
Eigen::VectorXd bump_at(const BiasView& desk, const Eigen::Vector2d& middle_px, double reach_px) {
  Eigen::VectorXd bump(static_cast<Eigen::Index>(desk.cells.size()));
  for (Eigen::Index i = 0; i < bump.size(); ++i)
    bump[i] = std::exp(-0.5 * (desk.cells[i].pixel_px() - middle_px).squaredNorm() / (reach_px * reach_px));
  return bump;
}

/// Of a measured Kinect the bias bends more at the image's edges than elsewhere, and beside things that hide the desk
/// squares hold bits of them (tests/diagnosis/unit/real_desks_test.cpp): only what lies off the edges with desk all
/// around is looked at.
bool is_amid_desk(const BiasView& desk, const BiasCell& middle, double reach_px) {
  constexpr double kOffEdges_px = 64.0, kSeen = 0.8;
  const Eigen::Vector2d at = middle.pixel_px(), beyond = Eigen::Vector2d(640.0, 480.0) - at;
  if (std::min(at.minCoeff(), beyond.minCoeff()) < kOffEdges_px) return false;
  const double around_px = 2.0 * reach_px;
  const auto seen = std::ranges::count_if(
      desk.cells, [&](const BiasCell& cell) { return (cell.pixel_px() - at).norm() < around_px; });
  const double whole = std::numbers::pi * around_px * around_px / (kBiasCell_px * kBiasCell_px);
  return static_cast<double>(seen) > kSeen * whole;
}

struct Candidate {
  BiasCell middle;
  double rank;
};

}  // namespace

std::optional<LocalBias> most_local_bias(const BiasView& desk, const BiasPrior& prior) {
  constexpr std::size_t kFewestCells = 100;
  constexpr std::size_t kExact = 12;  // likeliest bumps of each width whose σ is reckoned
  if (desk.cells.size() < kFewestCells) return std::nullopt;
  const BiasLearner learner({&desk, 1}, prior);
  const Eigen::VectorXd errors =
      Eigen::Map<const Eigen::VectorXd>(desk.errors_px.data(), static_cast<Eigen::Index>(desk.errors_px.size()));
  const Eigen::VectorXd weighted = learner.weighted(errors);
  std::optional<LocalBias> most;
  std::size_t looks = 0;
  for (const double reach_px : kBumps_px) {
    const double step_px = kBiasCell_px * std::floor(reach_px / kBiasCell_px);
    std::vector<Candidate> candidates;
    for (const BiasCell& cell : desk.cells) {
      if (std::fmod(cell.column_px - 0.5 * kBiasCell_px, step_px) != 0.0 ||
          std::fmod(cell.row_px - 0.5 * kBiasCell_px, step_px) != 0.0 || !is_amid_desk(desk, cell, reach_px))
        continue;
      candidates.push_back({cell, std::abs(bump_at(desk, cell.pixel_px(), reach_px).dot(weighted))});
    }
    looks += candidates.size();
    // σ changes little from place to place, so the largest ones are among those that the rank puts first.
    std::ranges::stable_sort(candidates, std::greater{}, &Candidate::rank);
    candidates.resize(std::min(candidates.size(), kExact));
    for (const Candidate& candidate : candidates) {
      const Eigen::VectorXd bump = bump_at(desk, candidate.middle.pixel_px(), reach_px);
      const double precision = bump.dot(learner.weighted(bump));
      if (!(precision > 0.0)) continue;
      const LocalBias found{candidate.middle.pixel_px(), reach_px, bump.dot(weighted) / precision,
                            1.0 / std::sqrt(precision), candidate.middle.nearer_px};
      if (!most || std::abs(found.bias_px) / found.sigma_px > std::abs(most->bias_px) / most->sigma_px) most = found;
    }
  }
  if (most) most->looks = looks;
  return most;
}

}  // namespace fathom
