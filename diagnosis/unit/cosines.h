// Smooth fields over the image as sums of cosines: a Gaussian process becomes independent numbers, one a wave, whose
// variances are its spectral density (Solin & Särkkä 2020, reduced-rank Gaussian processes).
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace fathom {

/// Over the image and what lies beside it in the frame of the reference. All of unit length there, orthogonal.
class Cosines {
 public:
  /// With waves up to this wave number [1/px].
  explicit Cosines(double most_per_px);

  static constexpr double kLeft_px = -110.0, kRight_px = 700.0, kTop_px = -60.0, kBottom_px = 540.0;

  int size() const { return static_cast<int>(waves_.size()); }
  int across() const { return across_; }
  int down() const { return down_; }
  /// Waves along rows and columns of each function.
  const std::vector<std::pair<int, int>>& waves() const { return waves_; }
  Eigen::VectorXd along_row(double column_px) const;  ///< across() values; beyond the border as at it
  Eigen::VectorXd along_column(double row_px) const;  ///< down() values
  /// Every function there.
  Eigen::VectorXd at(double column_px, double row_px) const;
  /// Variances of the functions' factors for a field of covariance exp(−r² / 2 reach²).
  Eigen::VectorXd density(double reach_px) const;

 private:
  int across_ = 0, down_ = 0;
  std::vector<std::pair<int, int>> waves_;
};

}  // namespace fathom
