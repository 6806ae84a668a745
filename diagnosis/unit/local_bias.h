// A place in the image where a device reads otherwise than its bias elsewhere lets expect: a smear on the lens, say.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "diagnosis/unit/bias_learner.h"
#include "diagnosis/unit/bias_view.h"

namespace fathom {

/// A bump of disparity, bias · exp(−r² / 2 reach²), on top of a bias that is a Gaussian process.
struct LocalBias {
  Eigen::Vector2d middle_px{0, 0};
  double reach_px = 0.0;
  double bias_px = 0.0;    ///< best by generalised least squares
  double sigma_px = 0.0;   ///< 1 σ of that, were the unit's bias there as it is elsewhere
  double nearer_px = 0.0;  ///< where the desk lies there, as BiasCell has it
  std::size_t looks = 0;   ///< bumps that were looked at

  /// Of chance making as much anywhere, at most.
  double p() const { return p_of_looks(bias_px / sigma_px, looks); }
};

/// The bump of 20 to 45 px that stands out most, in σ, from the bias that the learner takes for usual, alike in all of
/// the views that it was made of. Nothing where no place off the image's edges has desk all around.
std::optional<LocalBias> most_local_bias(const BiasLearner& learner, std::span<const BiasView> views);

}  // namespace fathom
