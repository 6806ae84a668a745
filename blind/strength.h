// How strongly an effect shows in a set: the norm of its whitened sensitivity once all that is uncertain anyway has
// been allowed to explain it.
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "blind/hidden.h"
#include "blind/pack_plan.h"
#include "blind/views.h"

namespace fathom::blind {

/// An effect, and how it shows.
struct Shown {
  Active active;
  double s;
  Eigen::MatrixXd sensitivity;
};

class Strengths {
 public:
  /// `views` of this design and perhaps others; it has to outlive this.
  Strengths(const Design& design, std::vector<Placement> placements, const Views& views);

  /// Whitened sensitivity, multiplied by (1 + N Nᵀ)^-1/2 for the nuisances' whitened sensitivities N per 1 σ: a column
  /// for each look. Zero for effects that do not show in means.
  Eigen::MatrixXd sensitivity(std::span<const Active> effects) const;

  /// Norm of what the looks at a sensitivity have in common: the root of the mean scalar product of two of them, 0
  /// where that is negative. Which dots happen to change windows differs from look to look, and no model of the effect
  /// could foretell it. Of an effect's sensitivity this is its strength s.
  static double common_norm(const Eigen::MatrixXd& looks);

  Shown shown(const Active& effect) const;

  /// The effect at a departure at which it has strength s, or the nearest that can be built, of the given sign.
  Shown sized(const Hidden& effect, double s, double sign) const;

  /// Norm of what is left of a sensitivity when these effects, freely scaled, have explained what they can.
  double escape(const Eigen::MatrixXd& sensitivity, std::span<const Hidden* const> registry) const;

  /// Root of the sum of squares by liquid: where an effect shows.
  std::map<std::string, double> by_liquid(const Eigen::MatrixXd& sensitivity) const;

 private:
  const ConditionViews& seen_from(std::size_t placement) const;
  /// `view_of(i)`, a view of placement i, minus the view of what is believed there, both as the laboratory records
  /// them: kReadings rows for each placement, a column for each look. 0 where one of the two is not seen.
  template <class ViewOf>
  Eigen::MatrixXd difference_of_views(const ViewOf& view_of) const;
  Eigen::MatrixXd difference(std::span<const Active> effects) const;
  /// Which dots and grains a window holds is nobody's knowledge: 1 σ of each reading under each condition, by which
  /// looks at what is believed differ.
  std::vector<Eigen::VectorXd> of_dots() const;
  void set_covariances(const std::vector<Eigen::VectorXd>& shared_by_placement);
  /// As if albedos were 1 σ larger: the cup's, or the milk's.
  Eigen::VectorXd brighter(bool of_milk) const;
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& difference) const;
  double of_spread(const Active& effect) const;
  double repeats() const;
  double scatter_error() const;

  Design design_;
  std::vector<Placement> placements_;
  const Views& views_;
  std::vector<Eigen::MatrixXd> block_root_;  ///< of each placement's covariance: noise and the cup's place
  Eigen::MatrixXd nuisance_axes_;            ///< orthonormal directions of N …
  Eigen::VectorXd nuisance_loss_;            ///< … and what each of them loses, 1 − 1/√(1 + S²)
};

}  // namespace fathom::blind
