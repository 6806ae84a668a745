#include "diagnosis/unit/calibration_view.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace fathom {
namespace {

constexpr int kCellColumns = static_cast<int>(640 / kBiasCell_px), kCellRows = static_cast<int>(480 / kBiasCell_px);
constexpr double kFromMean_px = 0.4;  ///< four times a pixel's noise and the steps of 1/8 px
constexpr double kLeastFilled = 0.35, kLeastDesk = 0.6;
constexpr std::size_t kFewestCells = 20;

struct Pixel {
  double u, v;       ///< x / z, y / z
  double disparity;  ///< [px]
  int cell;          ///< −1: outside of the image
};

std::vector<Pixel> pixels_of(std::span<const Points> clouds, const DeviceScale& scale) {
  std::vector<Pixel> pixels;
  for (const Points& points : clouds)
    for (const Eigen::Vector3f& point : points) {
      if (!point.allFinite() || !(point.z() > 0.0f)) continue;
      const Eigen::Vector2d at = (scale.pixel_px(point) / kBiasCell_px).array().floor();  // may be beyond any int
      const bool inside = at.x() >= 0.0 && at.x() < kCellColumns && at.y() >= 0.0 && at.y() < kCellRows;
      pixels.push_back({static_cast<double>(point.x()) / point.z(), static_cast<double>(point.y()) / point.z(),
                        scale.disparity_px(point.z()),
                        inside ? static_cast<int>(at.y()) * kCellColumns + static_cast<int>(at.x()) : -1});
    }
  return pixels;
}

/// disparity = q · (u, v, 1).
Eigen::Vector3d fit(const std::vector<Pixel>& pixels, const Eigen::Vector3d& from, double within_px) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Pixel& pixel : pixels) {
    const Eigen::Vector3d at(pixel.u, pixel.v, 1.0);
    if (std::abs(pixel.disparity - from.dot(at)) > within_px) continue;
    normal.noalias() += at * at.transpose();
    right += pixel.disparity * at;
  }
  return normal(2, 2) > 0.0 ? Eigen::Vector3d(normal.ldlt().solve(right)) : from;
}

struct Sums {
  std::vector<double> seen = std::vector<double>(kCellColumns * kCellRows), desk = seen, error = seen, disparity = seen;
};

/// Mean error of a cell and its neighbours, of those that hold desk.
std::vector<double> means_about(const Sums& sums) {
  std::vector<double> means(sums.desk.size());
  for (int y = 0; y < kCellRows; ++y)
    for (int x = 0; x < kCellColumns; ++x) {
      double error = 0.0, weight = 0.0;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, kCellRows - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, kCellColumns - 1); ++u)
          error += sums.error[v * kCellColumns + u], weight += sums.desk[v * kCellColumns + u];
      means[y * kCellColumns + x] = weight > 0.0 ? error / weight : 0.0;
    }
  return means;
}

Sums sums_of(const std::vector<Pixel>& pixels, const Eigen::Vector3d& plane, const std::vector<double>& about,
             double within_px) {
  Sums sums;
  for (const Pixel& pixel : pixels) {
    if (pixel.cell < 0) continue;
    sums.seen[pixel.cell] += 1.0;
    const double error = pixel.disparity - plane.dot(Eigen::Vector3d(pixel.u, pixel.v, 1.0));
    if (std::abs(error - about[pixel.cell]) > within_px) continue;
    sums.desk[pixel.cell] += 1.0;
    sums.error[pixel.cell] += error;
    sums.disparity[pixel.cell] += pixel.disparity - error;
  }
  return sums;
}

}  // namespace

std::optional<CalibrationView> desk_view(std::span<const Points> clouds, const Plane& guess, const DeviceScale& scale) {
  const std::vector<Pixel> pixels = pixels_of(clouds, scale);
  if (pixels.empty()) return std::nullopt;
  const double product = scale.focal_px * scale.baseline_m;
  Eigen::Vector3d plane = -guess.normal / guess.offset * product;
  constexpr double kWithin_px = 0.6;
  for (const double within_px : {2.0, 1.0, kWithin_px, kWithin_px, kWithin_px}) plane = fit(pixels, plane, within_px);
  Sums sums = sums_of(pixels, plane, std::vector<double>(kCellColumns * kCellRows), kWithin_px);
  for (int again = 0; again < 2; ++again) sums = sums_of(pixels, plane, means_about(sums), kFromMean_px);

  // A thinned cloud has fewer points in every cell.
  std::vector<double> filled;
  for (const double points : sums.seen)
    if (points > 0.0) filled.push_back(points);
  if (filled.size() < kFewestCells) return std::nullopt;
  const auto most = filled.begin() + static_cast<std::ptrdiff_t>(0.8 * static_cast<double>(filled.size()));
  std::nth_element(filled.begin(), most, filled.end());
  CalibrationView result;
  for (int cell = 0; cell < kCellColumns * kCellRows; ++cell) {
    if (sums.desk[cell] < kLeastFilled * *most || sums.desk[cell] < kLeastDesk * sums.seen[cell]) continue;
    const double points = sums.desk[cell];
    result.view.cells.push_back({(cell % kCellColumns + 0.5) * kBiasCell_px, (cell / kCellColumns + 0.5) * kBiasCell_px,
                                 sums.disparity[cell] / points - product / kReferenceDistance_m,
                                 std::min(points / *most, 1.0) * kBiasCell_px * kBiasCell_px});
    result.view.errors_px.push_back(sums.error[cell] / points);
  }
  if (result.view.cells.size() < kFewestCells) return std::nullopt;
  result.plane = {-plane.normalized(), product / plane.norm()};
  return result;
}

}  // namespace fathom
