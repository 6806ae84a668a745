#include "diagnosis/unit/local_bias.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "diagnosis/unit/desk_difference.h"

namespace fathom {
namespace {

/// Wider ones are what biases are like; narrower ones are lost in a cell.
constexpr std::array kBumps_px{20.0, 30.0, 45.0};

/// Of each cell of each view.
std::vector<Eigen::VectorXd> bump_at(std::span<const BiasView> views, const Eigen::Vector2d& middle_px,
                                     double reach_px) {
  std::vector<Eigen::VectorXd> bumps;
  for (const BiasView& view : views) {
    Eigen::VectorXd& bump = bumps.emplace_back(static_cast<Eigen::Index>(view.cells.size()));
    for (Eigen::Index i = 0; i < bump.size(); ++i)
      bump[i] = std::exp(-0.5 * (view.cells[i].pixel_px() - middle_px).squaredNorm() / (reach_px * reach_px));
  }
  return bumps;
}

double dot(std::span<const Eigen::VectorXd> a, std::span<const Eigen::VectorXd> b) {
  double sum = 0.0;
  for (std::size_t view = 0; view < a.size(); ++view) sum += a[view].dot(b[view]);
  return sum;
}

/// Every cell that any view shows, once.
std::vector<BiasCell> cells_of(std::span<const BiasView> views) {
  std::map<std::pair<double, double>, BiasCell> cells;
  for (const BiasView& view : views)
    for (const BiasCell& cell : view.cells) cells.try_emplace({cell.row_px, cell.column_px}, cell);
  std::vector<BiasCell> result;
  for (const auto& [at, cell] : cells) result.push_back(cell);
  return result;
}

/// Of a measured Kinect the bias bends more at the image's edges than elsewhere, and beside things that hide the desk
/// squares hold bits of them (tests/diagnosis/unit/real_desks_test.cpp): only what lies off the edges with desk all
/// around is looked at.
bool is_amid_desk(std::span<const BiasCell> desk, const BiasCell& middle, double reach_px) {
  constexpr double kOffEdges_px = 64.0, kSeen = 0.8;
  const Eigen::Vector2d at = middle.pixel_px(), beyond = Eigen::Vector2d(640.0, 480.0) - at;
  if (std::min(at.minCoeff(), beyond.minCoeff()) < kOffEdges_px) return false;
  const double around_px = 2.0 * reach_px;
  const auto seen =
      std::ranges::count_if(desk, [&](const BiasCell& cell) { return (cell.pixel_px() - at).norm() < around_px; });
  const double whole = std::numbers::pi * around_px * around_px / (kBiasCell_px * kBiasCell_px);
  return static_cast<double>(seen) > kSeen * whole;
}

struct Candidate {
  BiasCell middle;
  double rank;
};

}  // namespace

std::optional<LocalBias> most_local_bias(const BiasLearner& learner, std::span<const BiasView> views) {
  constexpr std::size_t kExact = 12;  // likeliest bumps of each width whose σ is reckoned
  const std::vector<Eigen::VectorXd> weighted = learner.weighted();
  const std::vector<BiasCell> desk = cells_of(views);
  std::optional<LocalBias> most;
  std::size_t looks = 0;
  for (const double reach_px : kBumps_px) {
    const double step_px = kBiasCell_px * std::floor(reach_px / kBiasCell_px);
    std::vector<Candidate> candidates;
    for (const BiasCell& cell : desk) {
      if (std::fmod(cell.column_px - 0.5 * kBiasCell_px, step_px) != 0.0 ||
          std::fmod(cell.row_px - 0.5 * kBiasCell_px, step_px) != 0.0 || !is_amid_desk(desk, cell, reach_px))
        continue;
      candidates.push_back({cell, std::abs(dot(bump_at(views, cell.pixel_px(), reach_px), weighted))});
    }
    looks += candidates.size();
    // σ changes little from place to place, so the largest ones are among those that the rank puts first.
    std::ranges::stable_sort(candidates, std::greater{}, &Candidate::rank);
    candidates.resize(std::min(candidates.size(), kExact));
    for (const Candidate& candidate : candidates) {
      const std::vector<Eigen::VectorXd> bump = bump_at(views, candidate.middle.pixel_px(), reach_px);
      const double precision = dot(bump, learner.weighted(bump));
      if (!(precision > 0.0)) continue;
      // A device with next to no bias has places of its own as well, as large as a view of a desk has them.
      const LocalBias found{candidate.middle.pixel_px(), reach_px, dot(bump, weighted) / precision,
                            std::hypot(1.0 / std::sqrt(precision), kOwnOfColumns_px), candidate.middle.nearer_px};
      if (!most || std::abs(found.bias_px) / found.sigma_px > std::abs(most->bias_px) / most->sigma_px) most = found;
    }
  }
  if (most) most->looks = looks;
  return most;
}

}  // namespace fathom
