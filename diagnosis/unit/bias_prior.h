// The assumed size and smoothness of a unit's bias, by default or learned from views.
#pragma once

#include <array>
#include <span>

#include "diagnosis/unit/bias_view.h"

namespace fathom {

/// Reaches [px] of the parts that a field's covariance is a sum of: Σ amplitude² exp(−r² / 2 reach²).
inline constexpr std::array kBiasReaches_px{20.0, 35.0, 70.0, 160.0};
using BiasAmplitudes = std::array<double, kBiasReaches_px.size()>;

/// Standard deviations [px].
struct BiasPrior {
  BiasAmplitudes reference_px{};  ///< of what moves with the reference image: column − nearer_px, row
  BiasAmplitudes camera_px{};     ///< of what stays at the camera's pixels
  BiasAmplitudes state_px{};      ///< of what the views of one state share beside that
  double cell_px = 0.02;          ///< of a view's own error of a whole cell: which dots a block happens to hold
  double columns_px = 0.0;        ///< of a view's own step from one column of cells to the next, the same in all rows
};

/// As the simulator draws units (sim/scene/unit_model): 0.1 px over 70 px, displaced with the reference image.
BiasPrior default_bias_prior();

/// By restricted marginal likelihood of the views; the default where there are fewer than three. No part is larger than
/// 0.3 px: what reaches beyond the image cannot be told from planes, and would grow without limit.
BiasPrior learned_bias_prior(std::span<const BiasView> views);

/// What one view of a desk says of how large and how smooth the bias is, and of its cells' own errors. Each part of
/// `thought` weighs as five independent waves. One view does not tell what moves with the reference image from what
/// stays in the camera's: the latter, and steps of columns, stay as they are.
BiasPrior bias_prior_of(const BiasView& desk, const BiasPrior& thought);

}  // namespace fathom
