// How strongly an effect shows in a set: the norm of its whitened signature once all that is uncertain anyway has been
// allowed to explain it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bench/blind/hidden.h"
#include "bench/blind/plan.h"

namespace fathom::blind {

class Strengths {
 public:
  /// `scale` multiplies the laboratory's errors and the device's noise, as in the set.
  Strengths(const Design& design, std::vector<Placement> placements, double scale);

  /// Whitened signature, multiplied by (1 + N Nᵀ)^-1/2 for the nuisances' whitened signatures N per 1 σ: a column for
  /// each look, that is with the cups a little elsewhere, where other dots fall into other windows. Zero for effects
  /// that only widen the spread of repeats.
  Eigen::MatrixXd signature(std::span<const Active> effects) const;

  /// Norm of what the looks at a signature have in common; s of an effect's. Which dots happen to change windows
  /// differs from look to look, and no model of the effect could foretell it.
  static double common_norm(const Eigen::MatrixXd& looks);

  /// s of one effect.
  double of(const Active& effect) const;

  /// A departure at which the effect has strength s, or the nearest that can be built, of the given sign.
  double departure_for(const Hidden& effect, double s, double sign) const;

  /// Norm of what is left of a signature when these effects, freely scaled, have explained what they can.
  double escape(const Eigen::MatrixXd& signature, std::span<const Hidden* const> registry) const;

  /// Root of the sum of squares by liquid: where an effect shows.
  std::map<std::string, double> by_liquid(const Eigen::MatrixXd& signature) const;

 private:
  using Change = std::function<void(World&, const Placement&)>;
  Eigen::MatrixXd values(const Change& change, bool over_time) const;  ///< a column for each look; NaN: not seen
  Eigen::MatrixXd difference(const Change& change, bool over_time = false) const;
  /// Of something that is uncertain by `sigma`, in the mean over looks.
  Eigen::VectorXd per_sigma(double sigma, const std::function<void(World&, double)>& add) const;
  /// As if albedos were 1 σ larger: the cup's, or the milk's.
  Eigen::VectorXd brighter(bool of_milk) const;
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& difference) const;
  double of_spread(const Active& effect) const;

  Design design_;
  std::vector<Placement> placements_;
  double scale_;
  Eigen::MatrixXd nominal_;
  std::vector<Eigen::MatrixXd> block_root_;  ///< of each placement's covariance: noise and the cup's place
  Eigen::MatrixXd nuisance_axes_;            ///< orthonormal directions of N …
  Eigen::VectorXd nuisance_loss_;            ///< … and what each of them loses, 1 − 1/√(1 + S²)
};

}  // namespace fathom::blind
