// What one frame says about desk and cup: the same estimators for a cloud's points and for a model's few rays.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>

#include "detector/plane.h"
#include "diagnosis/measurement/cup_outline.h"
#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/measurement/laboratory_rig.h"

namespace fathom {

/// Of the dots in the infrared image: the deviation of its brightness from place to place, over its mean. Pixels three
/// apart are compared, which is farther than a dot is wide and too near for shading to matter.
class DotContrast {
 public:
  /// Neighbours after each other, as the rows of an image have them.
  void add(double intensity, double weight);
  double contrast() const;  ///< 0 of nothing

 private:
  static constexpr std::size_t kApart = 3;
  std::array<double, kApart> before_{};
  std::size_t count_ = 0;
  double weight_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

/// A point as the sensor gives it.
struct SensedPoint {
  Eigen::Vector3f point;  ///< [m] camera frame
  float intensity;        ///< [DN]
  float weight = 1.0f;    ///< pixels that it stands for
  float device_z = 0.0f;  ///< [m] depth before a unit's bias was taken off; 0: none was
};

/// Of heights that stray from their median: where more do, what is seen is hardly one surface, but waves or two. Of a
/// surface a device matches a hundredth wrongly.
inline constexpr double kMostStray = 0.15;

/// Mean over points.
struct RegionEstimate {
  double mean = 0.0, sd = 0.0;
  double weight = 0.0;  ///< sum of the points' weights [pixels]
  double strays = 0.0;  ///< of those left out, being too far from the median

  double stray_share() const { return strays > 0.0 ? strays / (weight + strays) : 0.0; }
};

/// Mean disparity off the fitted desk's [px], of bands of 40 rows and of 40 columns of the image, and of its thirds.
struct DeskBands {
  std::array<RegionEstimate, 12> rows;
  std::array<RegionEstimate, 16> columns;
  std::array<RegionEstimate, 9> thirds;
  Plane desk;
  Eigen::Matrix3d sights = Eigen::Matrix3d::Zero();  ///< sum of s sᵀ over points of desk, s = (x/z, y/z, 1)
};

/// Codes of 1/8 px that the coarser combs have between their teeth.
inline constexpr std::array<int, 2> kCoarseCombs{2, 4};

struct FrameEstimates {
  Plane desk;
  std::array<RegionEstimate, 9> desk_residual;  ///< [m] heights above the fitted desk, by third of the image
  DeskBands desk_bands;
  RegionEstimate desk_intensity;  ///< [DN]
  std::array<RegionEstimate, 5>
      height;  ///< [m] above the fitted desk, by region of the cup; of what lies near the median
  std::array<RegionEstimate, kCupCells> cell_height;       ///< [m] the same of each cell of the raster (cup_regions.h)
  RegionEstimate interior;                                 ///< plain mean of all regions together
  RegionEstimate interior_intensity;                       ///< [DN]
  std::optional<double> desk_contrast, interior_contrast;  ///< of the infrared's dots (DotContrast); none without rows
  std::optional<CupOutline> outline;
  double step_comb = 0.0;                           ///< mean cosine of 2π · disparity in steps of 1/8 px, of the desk
  std::array<double, 2> coarse_combs = {0.0, 0.0};  ///< |mean exp(2πi · disparity)| in steps of 1/4 and 1/2 px
  bool spans_codes = false;                         ///< whether the desk lies in so many codes that these tell anything
  double millimetre_comb = 0.0;                     ///< mean cos of 2π · depth in mm, of the desk
};

/// How the points are looked at.
struct FrameView {
  std::optional<Eigen::Vector2d> cup;  ///< [m] world: where the cup should stand; nothing on a bare desk
  double fill_m = 0.0;                 ///< of what should stand in it
  double soft_m = 0.0;                 ///< width of the regions' borders
  bool has_rows = false;  ///< points come as in an image, neighbours after each other: dots have a contrast
  std::optional<Eigen::AlignedBox2d> desk_px{};  ///< part of the depth image in which desk counts; nothing: all of it
};

/// Desk: the plane by least squares in inverse depth, where a plane is linear and disparity's noise is even; from where
/// the rig puts it, in steps down to the points within 5 mm, apart from the cup's surroundings. Nothing when fewer than
/// a hundred pixels lie on it.
std::optional<FrameEstimates> estimate_frame(std::span<const SensedPoint> points, const LaboratoryRig& rig,
                                             const FrameView& view);

/// Number of the part that a point is seen in, row by row, of an image in so many `columns` and `rows`.
std::size_t part_of_image(const Eigen::Vector3f& point, double focal_px, int columns, int rows);

/// [m] about a cup's axis: nothing nearer counts as desk.
double clear_of_cup(const LaboratoryRig& rig);

/// [m] of a cup at a place of the rig's middle, from the foot of the camera, which is half a baseline beside it.
inline Eigen::Vector2d axis_from_camera(const LaboratoryRig& rig, const Eigen::Vector2d& cup) {
  return cup + Eigen::Vector2d(0.5 * rig.baseline_m, 0.0);
}

/// Of a point in the camera's frame, in the image of 640 x 480.
inline Eigen::Vector2d pixel_of(const LaboratoryRig& rig, const Eigen::Vector3d& point) {
  return rig.focal_px / point.z() * point.head<2>() + 0.5 * Eigen::Vector2d(kImageWidth_px, kImageHeight_px);
}

}  // namespace fathom
