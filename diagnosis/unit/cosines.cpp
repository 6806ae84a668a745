#include "diagnosis/unit/cosines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fathom {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFieldWidth = Cosines::kRight_px - Cosines::kLeft_px,
                 kFieldHeight = Cosines::kBottom_px - Cosines::kTop_px;

Eigen::VectorXd cosines(double from_border, double length, int count) {
  Eigen::VectorXd values(count);
  const double at = std::clamp(from_border, 0.0, length);
  for (int i = 0; i < count; ++i) values[i] = std::sqrt((i > 0 ? 2.0 : 1.0) / length) * std::cos(i * kPi / length * at);
  return values;
}

double squared_wave_number(const std::pair<int, int>& wave) {
  return std::pow(wave.first * kPi / kFieldWidth, 2.0) + std::pow(wave.second * kPi / kFieldHeight, 2.0);
}

}  // namespace

Cosines::Cosines(double most_per_px) {
  for (int i = 0; i * kPi / kFieldWidth <= most_per_px; ++i)
    for (int j = 0; j * kPi / kFieldHeight <= most_per_px; ++j)
      if (squared_wave_number({i, j}) <= most_per_px * most_per_px) {
        waves_.emplace_back(i, j);
        across_ = std::max(across_, i + 1), down_ = std::max(down_, j + 1);
      }
}

Eigen::VectorXd Cosines::along_row(double column_px) const {
  return cosines(column_px - kLeft_px, kFieldWidth, across_);
}

Eigen::VectorXd Cosines::along_column(double row_px) const { return cosines(row_px - kTop_px, kFieldHeight, down_); }

Eigen::VectorXd Cosines::at(double column_px, double row_px) const {
  const Eigen::VectorXd x = along_row(column_px), y = along_column(row_px);
  Eigen::VectorXd values(size());
  for (int k = 0; k < size(); ++k) values[k] = x[waves_[k].first] * y[waves_[k].second];
  return values;
}

Eigen::VectorXd Cosines::density(double reach_px) const {
  Eigen::VectorXd variances(size());
  for (int k = 0; k < size(); ++k)
    variances[k] =
        2.0 * kPi * reach_px * reach_px * std::exp(-0.5 * squared_wave_number(waves_[k]) * reach_px * reach_px);
  return variances;
}

}  // namespace fathom
