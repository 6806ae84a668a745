#include "tests/sensor/sparse_dots.h"

#include <algorithm>
#include <cmath>

#include "sim/sensor/ir_camera.h"

namespace fathom {
namespace {

/// Dots that are switched on stand this many grid steps apart, 12 infrared pixels.
constexpr int kSpacing = 6;
constexpr double kFillMm = 30.0;

Setup setup_of(double distance_mm, double absorption_per_mm) {
  Setup setup =
      cup_setup(kFillMm, distance_mm, distance_mm, R"(, "depth_size_px": [320, 240], "ir_size_px": [640, 512])");
  setup.scene.cups.front().filling->medium.absorption = per_metre_from_per_mm(absorption_per_mm);
  return setup;
}

}  // namespace

SparseDots::SparseDots(double distance_mm, double absorption_per_mm)
    : distance_mm_(distance_mm),
      view_(setup_of(distance_mm, absorption_per_mm)),
      pattern_(view_.rig.sensor.pattern, view_.rig.sensor.ir_scale()),
      truth_(trace_truth(view_.projector, view_.rig)) {
  std::vector<float> gains(static_cast<std::size_t>(pattern_.columns()) * pattern_.rows(), 0.0f);
  for (int row = 0; row < pattern_.rows(); ++row)
    for (int column = 0; column < pattern_.columns(); ++column)
      if (pattern_.has_dot(column, row) && stands_alone(column, row)) {
        lit_.emplace_back(column, row);
        gains[static_cast<std::size_t>(row) * pattern_.columns() + column] = 1.0f;
      }
  pattern_.set_dot_gains(gains);
}

Ground SparseDots::bottom() const {
  const Turbid& water = view_.geometry.bodies.front().medium;
  return {kPaperCupBottom, 0.70, metres_from_mm(kFillMm), water.n, water.absorption};
}

double SparseDots::dot_sigma() const {
  const SensorModel& sensor = view_.rig.sensor;
  return sensor.pattern.dot_sigma_ir_px / (sensor.ir_scale() * sensor.focal_px);
}

std::vector<SparseDot> SparseDots::on(const Ground& ground) const {
  const SensorModel& sensor = view_.rig.sensor;
  const Eigen::Vector2d middle = 0.5 * Eigen::Vector2d(pattern_.columns() - 1, pattern_.rows() - 1);
  std::vector<SparseDot> dots;
  for (const Eigen::Vector2i& dot : lit_) {
    const Eigen::Vector2d direction = (dot.cast<double>() - middle) * (sensor.pattern.step_px / sensor.focal_px);
    const DotImage exact = exact_dot(view_.rig, direction, ground);
    if (is_wholly_on(ground, exact.centre_ir_px)) dots.push_back({direction, exact});
  }
  return dots;
}

Image<float> SparseDots::image(int samples_across) const {
  return render_ir(view_.projector, view_.rig, pattern_, samples_across, LightModel::direct, 1).projected;
}

/// Dots are taken row by row, where none of those taken before is near.
bool SparseDots::stands_alone(int column, int row) const {
  return std::none_of(lit_.rbegin(), lit_.rend(), [&](const Eigen::Vector2i& other) {
    return std::abs(other.x() - column) < kSpacing && std::abs(other.y() - row) < kSpacing;
  });
}

bool SparseDots::is_wholly_on(const Ground& ground, const Eigen::Vector2d& centre_ir_px) const {
  const SensorModel& sensor = view_.rig.sensor;
  const int reach = kDotReachIrPx / 2 + 1;
  const int x = static_cast<int>(centre_ir_px.x() / sensor.ir_scale());
  const int y = static_cast<int>((centre_ir_px.y() - sensor.ir_first_row()) / sensor.ir_scale());
  if (x < reach || y < reach || x >= sensor.width - reach || y >= sensor.height - reach) return false;
  for (int j = y - reach; j <= y + reach; ++j)
    for (int i = x - reach; i <= x + reach; ++i)
      if (!truth_(i, j).apparent_depth || std::fabs(truth_(i, j).position.z() - ground.z) > 1e-9) return false;
  return true;
}

DotImage measured_dot(const Image<float>& image, const Eigen::Vector2d& near_ir_px) {
  DotImage dot{Eigen::Vector2d::Zero(), 0.0};
  const int x = static_cast<int>(near_ir_px.x()), y = static_cast<int>(near_ir_px.y());
  for (int j = y - kDotReachIrPx; j <= y + kDotReachIrPx; ++j)
    for (int i = x - kDotReachIrPx; i <= x + kDotReachIrPx; ++i) {
      dot.sum_dn += image(i, j);
      dot.centre_ir_px += image(i, j) * Eigen::Vector2d(i + 0.5, j + 0.5);
    }
  dot.centre_ir_px /= dot.sum_dn;
  return dot;
}

}  // namespace fathom
