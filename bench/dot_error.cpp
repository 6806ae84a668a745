#include "bench/dot_error.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace fathom {
namespace {

/// What the pixels around a dot must be. Across a dot refraction is linear: a Gaussian becomes one of another shape.
class ExactPixels {
 public:
  ExactPixels(const Rig& rig, double sigma, const SparseDot& dot, const Ground& ground) : exact_(dot.exact) {
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = sigma * Eigen::Vector2d::Unit(axis);
      ir_px_from_sigmas_.col(axis) = 0.5 * (exact_dot(rig, dot.direction + step, ground).centre_ir_px -
                                            exact_dot(rig, dot.direction - step, ground).centre_ir_px);
    }
    sigmas_from_ir_px_ = ir_px_from_sigmas_.inverse();
  }

  /// Mean over a pixel.
  double operator()(int x, int y) const {
    constexpr int kAcross = 4;
    double sum = 0.0;
    for (int j = 0; j < kAcross; ++j)
      for (int i = 0; i < kAcross; ++i)
        sum += at({x + (i + 0.5) / kAcross, y + (j + 0.5) / kAcross}) / (kAcross * kAcross);
    return sum;
  }

 private:
  double at(const Eigen::Vector2d& ir_px) const {
    return exact_.sum_dn / (2.0 * std::numbers::pi * std::fabs(ir_px_from_sigmas_.determinant())) *
           std::exp(-0.5 * (sigmas_from_ir_px_ * (ir_px - exact_.centre_ir_px)).squaredNorm());
  }

  DotImage exact_;
  Eigen::Matrix2d ir_px_from_sigmas_, sigmas_from_ir_px_;
};

/// Light of some dots over what is exact.
double brightness(const std::vector<SparseDot>& dots, const Image<float>& image) {
  double measured = 0.0, exact = 0.0;
  for (const SparseDot& dot : dots) {
    measured += measured_dot(image, dot.exact.centre_ir_px).sum_dn;
    exact += dot.exact.sum_dn;
  }
  return measured / exact;
}

}  // namespace

DotError dot_error(const SparseDots& dots, const Image<float>& image) {
  const std::vector<SparseDot> on_bottom = dots.on(dots.bottom());
  double squared_distances = 0.0, exact_squares = 0.0, image_squares = 0.0, products = 0.0;
  for (const SparseDot& dot : on_bottom) {
    const Eigen::Vector2d& centre = dot.exact.centre_ir_px;
    squared_distances += (measured_dot(image, centre).centre_ir_px - centre).squaredNorm();
    const ExactPixels exact_pixels(dots.view().rig, dots.dot_sigma(), dot, dots.bottom());
    const int x = static_cast<int>(centre.x()), y = static_cast<int>(centre.y());
    for (int j = y - kDotReachIrPx; j <= y + kDotReachIrPx; ++j)
      for (int i = x - kDotReachIrPx; i <= x + kDotReachIrPx; ++i) {
        const double exact = exact_pixels(i, j), value = image(i, j);
        exact_squares += exact * exact;
        image_squares += value * value;
        products += exact * value;
      }
  }
  // min over s of Σ (s value − exact)² = Σ exact² − (Σ exact value)² / Σ value².
  return {static_cast<int>(on_bottom.size()), std::sqrt(squared_distances / static_cast<double>(on_bottom.size())),
          brightness(on_bottom, image) / brightness(dots.on(dots.desk()), image),
          std::sqrt(1.0 - products * products / (image_squares * exact_squares))};
}

}  // namespace fathom
