// The noise of a desk's disparities and over how many pixels it is the same.
#pragma once

#include <array>

#include "detector/plane.h"
#include "diagnosis/unit/calibration_view.h"

namespace fathom {

inline constexpr std::array kNoiseLags_px{1, 2, 4, 8};

struct PixelNoise {
  double sigma_px = 0.0;
  std::array<double, kNoiseLags_px.size()> along_rows{}, along_columns{};  ///< correlation at each lag
};

/// Sums over clouds; the plane is that of the cloud's desk. Windows of 31 × 31 pixels whose own plane is taken out, as
/// bench/desk_noise does, in which nine of ten pixels are desk.
class NoiseSums {
 public:
  /// `width` columns; 1 row of points: they are put where the scale has them.
  void add(const Points& points, int width, const Plane& desk, const DeviceScale& scale);
  PixelNoise noise() const;

 private:
  double pixels_ = 0.0, squares_ = 0.0;
  std::array<double, kNoiseLags_px.size()> row_products_{}, row_pairs_{}, column_products_{}, column_pairs_{};
};

}  // namespace fathom
