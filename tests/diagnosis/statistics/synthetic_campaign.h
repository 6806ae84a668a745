// A small world in which everything is known: campaigns with smooth, nearly linear effects and errors of every kind
// that a laboratory makes. It shares nothing with the analysis but what Evidence and Predict are.
#pragma once

#include <Eigen/Cholesky>
#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct CampaignDesign {
  std::vector<double> distances_mm{200, 300, 400}, laterals_mm{-100, 0, 100}, fills_mm{10, 30, 60};
  std::vector<std::string> liquids{"water", "milk_tea"};
  std::vector<std::string> regions{"centre", "ring"};
  bool has_infrared = true;
  bool has_desk = true;
  int pours = 2;       ///< of each filling
  int placements = 1;  ///< of each pour at each place
  int repeats = 10;
  int sessions = 2;
  bool turns_about = false;  ///< every other pour goes through the fillings backwards: time is not condition
};

struct Errors {
  double scale = 1.0;        ///< of all real errors and nuisances, against those stated
  bool heavy_tails = false;  ///< of measurement: Student's t of 3 degrees of freedom, of the same variance
  bool silent = false;       ///< no error at all but the nuisances
  double dust = 0.0;         ///< strength of small smooth departures that nothing describes
};

/// A campaign without errors or effects: its conditions, its true model.
class World {
 public:
  explicit World(const CampaignDesign& design = {});

  /// As the laboratory sees it: nominal predictions, nuisances with priors, candidates with sensitivities.
  const Evidence& nominal() const { return nominal_; }
  Predict predict() const;
  int candidate(const std::string& effect) const;

  /// Measured values in which `truth` is on, and beside it something unregistered of the given whitened size.
  Evidence measure(const std::vector<EffectValue>& truth, const Errors& errors, std::uint64_t seed,
                   const Eigen::VectorXd& unregistered = {}) const;

  /// The covariance from which errors are really drawn.
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  /// Norm of a change of the observations in units of it: strength.
  double strength(const Eigen::VectorXd& change) const;
  /// The value of one-parameter `effect` at which it has a strength, positive or negative as `sign` and bounds say.
  EffectValue at_strength(const std::string& effect, double strength, double sign) const;
  /// A smooth random departure whose part outside all candidates' span has strength `escape`.
  Eigen::VectorXd escaping(double escape, std::uint64_t seed) const;

 private:
  Evidence nominal_;
  Eigen::MatrixXd covariance_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace fathom
