// A unit's bias of disparity as a field over the image.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image.h"
#include "diagnosis/unit/bias_view.h"
#include "diagnosis/unit/cosines.h"

namespace fathom {

/// A place of the depth image (first pixel's centre 0.5, 0.5), what is seen there, and when.
struct BiasPoint {
  Eigen::Vector2d pixel_px;
  double nearer_px = 0.0;
  int state = kNoState;
};

/// Factors of the cosines; empty: nothing.
struct BiasFactors {
  Eigen::VectorXd reference, camera;
  std::vector<Eigen::VectorXd> states;
};

class BiasField {
 public:
  BiasField() = default;
  BiasField(const Cosines& cosines, const BiasFactors& factors);

  /// [px] measured minus true disparity, bilinear.
  double at(const BiasPoint& point) const;
  double reference_at(double column_px, double row_px) const { return look_up(reference_, column_px, row_px); }
  double camera_at(double column_px, double row_px) const { return look_up(camera_, column_px, row_px); }

 private:
  static double look_up(const Image<float>& table, double column_px, double row_px);
  Image<float> reference_, camera_;
  std::vector<Image<float>> states_;
};

}  // namespace fathom
