#include "diagnosis/measurement/frame_estimates.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <complex>
#include <numbers>
#include <vector>

#include "core/units.h"
#include "diagnosis/unit/bias_view.h"

namespace fathom {
namespace {

constexpr double kLeastHeight = -0.010, kMostHeight = 0.100;  ///< [m] of what is seen in a cup (detector/liquid.h)
constexpr double kFewestOfDesk = 100.0;
// A plane of few codes, or of pixels at distances that are whole steps apart, has teeth of its own.
constexpr double kManyCodes = 8.0;      // deviation
constexpr double kTeethOfPlane = 0.25;  // a desk seen by all pixels has up to 0.15

/// Sums for mean and standard deviation.
struct Sums {
  double weight = 0.0, first = 0.0, second = 0.0;

  void add(double value, double w) { weight += w, first += w * value, second += w * value * value; }
  RegionEstimate estimate() const {
    if (weight <= 0.0) return {};
    const double mean = first / weight;
    return {mean, std::sqrt(std::max(second / weight - mean * mean, 0.0)), weight};
  }
};

/// Points of the desk in the frame whose origin is the desk below the camera (desk_from_camera).
struct CupPlace {
  Eigen::Vector2d centre;
  double clear_of_cup;  ///< [m] radius around it in which nothing counts as desk
};

std::optional<CupPlace> place_of(const FrameView& view, const LaboratoryRig& rig) {
  if (!view.cup) return std::nullopt;
  return CupPlace{axis_from_camera(rig, *view.cup), clear_of_cup(rig)};
}

/// 1/z = q · (x/z, y/z, 1) for the points within `gate` of the plane; q = −n / offset.
std::optional<Plane> refit(std::span<const SensedPoint> points, const Plane& desk, double gate,
                           const std::optional<CupPlace>& cup) {
  const Eigen::Isometry3d to_desk = desk_from_camera(desk);
  const Eigen::Vector2d axis = cup ? cup->centre : Eigen::Vector2d::Zero();
  const double clear = cup ? cup->clear_of_cup * cup->clear_of_cup : -1.0;
  const Eigen::Matrix3f turn = to_desk.linear().cast<float>();
  const float offset = static_cast<float>(to_desk.translation().z()), within = static_cast<float>(gate);
  double uu = 0, uv = 0, vv = 0, u1 = 0, v1 = 0, ww = 0, uq = 0, vq = 0, qq = 0;
  for (const SensedPoint& sensed : points) {
    const Eigen::Vector3f p = turn * sensed.point;
    if (std::abs(p.z() + offset) > within) continue;
    if ((p.head<2>().cast<double>() - axis).squaredNorm() < clear) continue;
    const double w = sensed.weight, inverse = 1.0 / sensed.point.z();
    const double u = sensed.point.x() * inverse, v = sensed.point.y() * inverse;
    uu += w * u * u, uv += w * u * v, vv += w * v * v, u1 += w * u, v1 += w * v, ww += w;
    uq += w * u * inverse, vq += w * v * inverse, qq += w * inverse;
  }
  if (ww < kFewestOfDesk) return std::nullopt;
  Eigen::Matrix3d normal;
  normal << uu, uv, u1, uv, vv, v1, u1, v1, ww;
  const Eigen::Vector3d q = normal.ldlt().solve(Eigen::Vector3d(uq, vq, qq));
  if (!(q.norm() > 0.0)) return std::nullopt;
  return Plane{-q.normalized(), 1.0 / q.norm()};
}

std::optional<Plane> fit_desk(std::span<const SensedPoint> points, const LaboratoryRig& rig,
                              const std::optional<CupPlace>& cup) {
  std::optional<Plane> desk = plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad});
  for (const double gate : {0.060, 0.020, 0.008, 0.005, 0.005})
    if (desk) desk = refit(points, *desk, gate, cup);
  return desk;
}

/// A point of the cup or next to it.
struct CupPoint {
  Eigen::Vector2d from_axis;  ///< [m] of where the cup should stand
  float height, intensity, weight;
};

/// About which regions of the cup lie: where it should stand or, if its walls are farther beside that than regions keep
/// clear of walls and windows, so much nearer to where they are. What noise makes of the walls thus moves no region.
Eigen::Vector2d middle_of_regions(const std::optional<CupOutline>& outline) {
  constexpr double kFree = 0.002;  // [m]
  if (!outline || outline->off.norm() <= kFree) return Eigen::Vector2d::Zero();
  return (1.0 - kFree / outline->off.norm()) * outline->off;
}

/// Mean of a region. A hundredth of a device's pixels is matched wrongly, off by pixels; a single one of them weighs as
/// much as the noise of thousands, and of a low bottom those that are too low are no longer the cup's. So only heights
/// near the median count: within half a pixel of disparity, which is five times what noise and blocks make.
RegionEstimate region_mean(std::vector<SharedHeight>& heights) {
  constexpr float kNear = 0.006f;  // [m] half a pixel, 0.75 m away
  if (heights.empty()) return {};
  const float middle = middle_height(heights);
  Sums sums;
  double strays = 0.0;
  for (const SharedHeight& one : heights)
    if (std::abs(one.height - middle) <= kNear)
      sums.add(one.height, one.weight);
    else
      strays += one.weight;
  RegionEstimate estimate = sums.estimate();
  estimate.strays = strays;
  return estimate;
}

void set_inside(std::span<const CupPoint> points, double radius, const FrameView& view, FrameEstimates& estimates) {
  const Eigen::Vector2d axis = middle_of_regions(estimates.outline);
  const double soft = view.soft_m, reach = radius + soft;
  std::array<std::vector<SharedHeight>, 5> height;
  std::array<std::vector<SharedHeight>, kCupCells> cell_height;
  Sums interior, intensity;
  DotContrast dots;
  for (const CupPoint& p : points) {
    const Eigen::Vector2d from_axis = p.from_axis - axis;
    if (from_axis.squaredNorm() > reach * reach || p.height < kLeastHeight || p.height > kMostHeight) continue;
    const std::array<double, 5> shares = shares_of_regions(from_axis, radius, soft);
    double whole = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i)
      if (shares[i] > 0.0) {
        height[i].push_back({p.height, static_cast<float>(p.weight * shares[i])});
        whole += shares[i];
      }
    if (const int cell = cup_cell_of(from_axis, radius); cell >= 0) cell_height[cell].push_back({p.height, p.weight});
    interior.add(p.height, p.weight * whole);
    intensity.add(p.intensity, p.weight * whole);
    if (view.has_rows && whole > 0.0) dots.add(p.intensity, p.weight * whole);
  }
  for (std::size_t i = 0; i < height.size(); ++i) estimates.height[i] = region_mean(height[i]);
  for (std::size_t i = 0; i < cell_height.size(); ++i) estimates.cell_height[i] = region_mean(cell_height[i]);
  estimates.interior = interior.estimate();
  estimates.interior_intensity = intensity.estimate();
  if (view.has_rows) estimates.interior_contrast = dots.contrast();
}

}  // namespace

void DotContrast::add(double intensity, double weight) {
  double& before = before_[count_ % kApart];
  if (count_ >= kApart) {
    weight_ += weight;
    sum_ += weight * intensity;
    squares_ += weight * 0.5 * (intensity - before) * (intensity - before);
  }
  before = intensity;
  ++count_;
}

double DotContrast::contrast() const { return sum_ > 0.0 ? std::sqrt(squares_ * weight_) / sum_ : 0.0; }

double clear_of_cup(const LaboratoryRig& rig) {
  constexpr double kAround = 0.025;  // a cup's foot, its windows' reach and its own place's error
  return rig.cup.widest() + kAround;
}

std::size_t part_of_image(const Eigen::Vector3f& point, double focal_px, int columns, int rows) {
  const double column = focal_px * point.x() / point.z() / kImageWidth_px + 0.5,
               row = focal_px * point.y() / point.z() / kImageHeight_px + 0.5;
  const auto part = [](double share, int parts) {
    return static_cast<std::size_t>(std::clamp(share * parts, 0.0, parts - 1.0));
  };
  return columns * part(row, rows) + part(column, columns);
}

namespace {

/// Apart from the cup's surroundings, as the rig puts them, what lies in that part of the image.
std::vector<SensedPoint> within(const Eigen::AlignedBox2d& part_px, std::span<const SensedPoint> points,
                                const LaboratoryRig& rig, const std::optional<CupPlace>& cup) {
  const Eigen::Isometry3d to_desk = desk_from_camera(plane_from(DeskPrior{rig.height_m, rig.pitch_rad, rig.roll_rad}));
  std::vector<SensedPoint> result;
  for (const SensedPoint& sensed : points) {
    const Eigen::Vector3d point = sensed.point.cast<double>();
    const bool is_about_cup = cup && ((to_desk * point).head<2>() - cup->centre).norm() < cup->clear_of_cup;
    if (is_about_cup || part_px.contains(pixel_of(rig, point))) result.push_back(sensed);
  }
  return result;
}

}  // namespace

std::optional<FrameEstimates> estimate_frame(std::span<const SensedPoint> points, const LaboratoryRig& rig,
                                             const FrameView& view) {
  if (view.desk_px) {
    FrameView all = view;
    all.desk_px.reset();
    return estimate_frame(within(*view.desk_px, points, rig, place_of(view, rig)), rig, all);
  }
  const std::optional<CupPlace> cup = place_of(view, rig);
  const std::optional<Plane> desk = fit_desk(points, rig, cup);
  if (!desk) return std::nullopt;
  const Eigen::Isometry3d to_desk = desk_from_camera(*desk);
  const Eigen::Matrix3f turn = to_desk.linear().cast<float>();
  const Eigen::Vector3f shift = to_desk.translation().cast<float>();
  const double steps_per_inverse = 8.0 * rig.focal_px * rig.baseline_m, two_pi = 2.0 * std::numbers::pi;
  constexpr float kOnDesk = 0.005f;
  const Eigen::Vector3d inverse_desk = -desk->normal / desk->offset;  // 1/z of the desk = that · (x/z, y/z, 1)
  std::array<Sums, 9> residual, thirds;
  Eigen::Matrix3d sights = Eigen::Matrix3d::Zero();
  std::array<Sums, std::tuple_size_v<decltype(DeskBands::rows)>> rows;
  std::array<Sums, std::tuple_size_v<decltype(DeskBands::columns)>> columns;
  Sums desk_intensity;
  DotContrast desk_dots;
  std::vector<CupPoint> around;
  std::optional<OutlineFit> outline;
  if (cup) outline.emplace(rig, cup->centre, view.fill_m);
  const double walls_reach = cup ? outline->reach() : 0.0;
  std::complex<double> comb;
  std::array<std::complex<double>, 2> coarse, coarse_of_plane;
  double millimetres = 0.0;
  Sums codes;
  // Combs are taken of some of the points: ten thousands are enough, cosines are dear.
  const std::size_t comb_every = points.size() > 100'000 ? 7 : 3;
  for (std::size_t number = 0; number < points.size(); ++number) {
    const SensedPoint& sensed = points[number];
    const Eigen::Vector3f p = turn * sensed.point + shift;
    const Eigen::Vector2d from_axis = p.head<2>().cast<double>() - (cup ? cup->centre : Eigen::Vector2d::Zero());
    const double squared = from_axis.squaredNorm(), w = sensed.weight;
    if (squared < walls_reach * walls_reach) outline->add(from_axis, p.z(), w);
    if (cup && squared < cup->clear_of_cup * cup->clear_of_cup) {
      around.push_back({from_axis, p.z(), sensed.intensity, sensed.weight});
      continue;
    }
    if (std::abs(p.z()) > kOnDesk) continue;
    const Eigen::Vector3d seen = sensed.point.cast<double>();
    const double off_px = rig.focal_px * rig.baseline_m * (1.0 - inverse_desk.dot(seen)) / seen.z();
    const std::size_t third = part_of_image(sensed.point, rig.focal_px, 3, 3);
    residual[third].add(p.z(), w);
    thirds[third].add(off_px, w);
    const Eigen::Vector3d sight = seen / seen.z();
    sights += w * sight * sight.transpose();
    rows[part_of_image(sensed.point, rig.focal_px, 1, static_cast<int>(rows.size()))].add(off_px, w);
    columns[part_of_image(sensed.point, rig.focal_px, static_cast<int>(columns.size()), 1)].add(off_px, w);
    desk_intensity.add(sensed.intensity, w);
    if (view.has_rows) desk_dots.add(sensed.intensity, w);
    if (number % comb_every != 0) continue;
    // Depths are cut to millimetres: what was cut off is half of one in the mean.
    const double z = sensed.device_z > 0.0f ? sensed.device_z : sensed.point.z();  // steps are the device's
    const double steps = steps_per_inverse * (1.0 / kReferenceDistance_m - 1.0 / (z + 0.5 * kMetresPerMm)) - 0.5;
    codes.add(steps, w);
    const std::complex<double> of_half = std::polar(1.0, 0.25 * two_pi * steps), of_quarter = of_half * of_half;
    coarse[0] += w * of_quarter;
    coarse[1] += w * of_half;
    const double steps_of_plane =
        steps_per_inverse * (1.0 / kReferenceDistance_m - inverse_desk.dot(seen) / seen.z()) - 0.5;
    const std::complex<double> half_of_plane = std::polar(1.0, 0.25 * two_pi * steps_of_plane);
    coarse_of_plane[0] += w * half_of_plane * half_of_plane;
    coarse_of_plane[1] += w * half_of_plane;
    comb += w * of_quarter * of_quarter;
    millimetres += w * std::cos(two_pi * mm_from_metres(z));
  }
  FrameEstimates estimates;
  estimates.desk = *desk;
  for (std::size_t i = 0; i < residual.size(); ++i) estimates.desk_residual[i] = residual[i].estimate();
  for (std::size_t i = 0; i < thirds.size(); ++i) estimates.desk_bands.thirds[i] = thirds[i].estimate();
  estimates.desk_bands.desk = *desk;
  estimates.desk_bands.sights = sights;
  for (std::size_t i = 0; i < rows.size(); ++i) estimates.desk_bands.rows[i] = rows[i].estimate();
  for (std::size_t i = 0; i < columns.size(); ++i) estimates.desk_bands.columns[i] = columns[i].estimate();
  estimates.desk_intensity = desk_intensity.estimate();
  if (view.has_rows) estimates.desk_contrast = desk_dots.contrast();
  if (outline) estimates.outline = outline->solve();
  set_inside(around, interior_radius(rig.cup), view, estimates);
  if (codes.weight > 0.0) {
    estimates.step_comb = comb.real() / codes.weight;
    const auto length = [&](const std::complex<double>& sum) { return std::abs(sum) / codes.weight; };
    for (std::size_t i = 0; i < coarse.size(); ++i) estimates.coarse_combs[i] = length(coarse[i]);
    estimates.spans_codes = codes.estimate().sd > kManyCodes &&
                            std::max(length(coarse_of_plane[0]), length(coarse_of_plane[1])) < kTeethOfPlane;
    estimates.millimetre_comb = millimetres / codes.weight;
  }
  return estimates;
}

}  // namespace fathom
