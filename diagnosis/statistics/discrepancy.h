// Structured discrepancy: departures for which no candidate stands, as Gaussian processes of unknown size.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/strata.h"
#include "diagnosis/statistics/variance_profile.h"

namespace fathom {

/// A process by the directions of its whitened columns, orthonormal, and its variance along each at size 1.
class Spectrum {
 public:
  Spectrum() = default;  ///< empty
  explicit Spectrum(const Eigen::MatrixXd& columns);

  bool is_empty() const { return values_.size() == 0; }
  double half_log_det(double size) const;
  /// x in units of errors and process together.
  Eigen::MatrixXd whiten(double size, const Eigen::MatrixXd& x) const;
  /// Of the columns, in the process's mean.
  Eigen::VectorXd weights(double size, const Eigen::VectorXd& residual) const;
  double log_evidence(double size, const Eigen::VectorXd& residual) const;

 private:
  Eigen::ArrayXd share(double size) const { return 1.0 - 1.0 / (1.0 + size * size * values_); }

  Eigen::ArrayXd values_;
  Eigen::MatrixXd along_, to_weights_;
};

/// Two kinds, equally likely beforehand: a smooth departure, over all places or within the cup, and a shift of one
/// stratum (by one factor: a liquid, a session, a region, a time), each as likely as another. The size of either is a
/// few errors of a single observation.
struct Discrepancy {
  /// n × r, its square is the smooth process's covariance: squared exponential in fill, distance and lateral (each over
  /// the length of its range), half shared between liquids and between regions, apart for each observable. Pivoted
  /// Cholesky (Harbrecht, Peters & Schneider 2012), r ≤ 400. Not whitened, and whitened.
  Eigen::MatrixXd smooth_factor, smooth;
  Spectrum of_smooth;      ///< of that
  Spectrum of_apart;       ///< of the same process with nothing shared
  Spectrum of_shape;       ///< of a smooth shape of what is seen in cups; empty where none was measured
  Eigen::MatrixXd strata;  ///< n × strata, of one error's size, whitened
};

Discrepancy discrepancy_of(const Evidence& evidence, const std::vector<Stratum>& strata, const Covariance& covariance);

/// Effects near their fit, whitened: what they and a discrepancy may share is not counted twice.
struct LinearEffects {
  Eigen::VectorXd response;  ///< measured minus nominal, as a linear model has it: jacobian · parameters + errors
  Eigen::MatrixXd jacobian;  ///< per prior scale
  Eigen::VectorXd parameters, lower, upper;
};

/// Effects beside one discrepancy of one size, at their best parameters.
struct Beside {
  double log_likelihood = 0.0;  ///< with the discrepancy alone against without, and log F of what both leave
  double gain = 0.0;            ///< decrease of the whitened squared norm by the effects
  Eigen::VectorXd parameters;
  Eigen::MatrixXd gram;  ///< of the Jacobian, in units of errors and discrepancy together
};

/// Every discrepancy that is likely beside these effects, each with its log prior weight.
std::vector<std::pair<double, Beside>> beside(const Discrepancy& discrepancy, const VarianceProfile& variances,
                                              const LinearEffects& effects);

/// Whitened columns once more, in units of errors and the discrepancy that is likeliest of a residual together.
Eigen::MatrixXd whiten_beside(const Discrepancy& discrepancy, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& x);

/// Whether the likeliest discrepancy is a shape of what is seen in cups.
bool is_shape(const Discrepancy& discrepancy, const Eigen::VectorXd& residual);

/// The smooth process's mean given the residual, at its likeliest size, for each observation; not whitened.
Eigen::VectorXd smooth_map(const Discrepancy& discrepancy, const Eigen::VectorXd& residual,
                           const Eigen::MatrixXd& explained);

}  // namespace fathom
