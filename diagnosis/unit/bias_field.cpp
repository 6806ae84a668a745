#include "diagnosis/unit/bias_field.h"

#include <algorithm>
#include <cmath>

namespace fathom {
namespace {

constexpr double kStep_px = 8.0;  ///< of the tables; the shortest wave is six times as long
constexpr int kColumns = static_cast<int>((Cosines::kRight_px - Cosines::kLeft_px) / kStep_px) + 2;
constexpr int kRows = static_cast<int>((Cosines::kBottom_px - Cosines::kTop_px) / kStep_px) + 2;

Image<float> table_of(const Cosines& cosines, const Eigen::VectorXd& factors) {
  if (factors.size() == 0) return {};
  Eigen::MatrixXd of_waves = Eigen::MatrixXd::Zero(cosines.down(), cosines.across());
  for (int k = 0; k < cosines.size(); ++k) of_waves(cosines.waves()[k].second, cosines.waves()[k].first) = factors[k];
  Eigen::MatrixXd across(cosines.across(), kColumns);
  for (int x = 0; x < kColumns; ++x) across.col(x) = cosines.along_row(Cosines::kLeft_px + kStep_px * x);
  const Eigen::MatrixXd along_rows = of_waves * across;
  Image<float> table(kColumns, kRows);
  for (int y = 0; y < kRows; ++y) {
    const Eigen::RowVectorXd row = cosines.along_column(Cosines::kTop_px + kStep_px * y).transpose() * along_rows;
    for (int x = 0; x < kColumns; ++x) table(x, y) = static_cast<float>(row[x]);
  }
  return table;
}

}  // namespace

BiasField::BiasField(const Cosines& cosines, const BiasFactors& factors)
    : reference_(table_of(cosines, factors.reference)), camera_(table_of(cosines, factors.camera)) {
  for (const Eigen::VectorXd& state : factors.states) states_.push_back(table_of(cosines, state));
}

double BiasField::look_up(const Image<float>& table, double column_px, double row_px) {
  if (table.empty()) return 0.0;
  const double x = std::clamp((column_px - Cosines::kLeft_px) / kStep_px, 0.0, kColumns - 1.001);
  const double y = std::clamp((row_px - Cosines::kTop_px) / kStep_px, 0.0, kRows - 1.001);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const double u = x - left, v = y - top;
  return (1.0 - v) * ((1.0 - u) * table(left, top) + u * table(left + 1, top)) +
         v * ((1.0 - u) * table(left, top + 1) + u * table(left + 1, top + 1));
}

double BiasField::at(const BiasPoint& point) const {
  const double x = point.pixel_px.x(), y = point.pixel_px.y();
  double bias = look_up(reference_, x - point.nearer_px, y) + look_up(camera_, x, y);
  if (point.state >= 0 && point.state < static_cast<int>(states_.size())) bias += look_up(states_[point.state], x, y);
  return bias;
}

}  // namespace fathom
