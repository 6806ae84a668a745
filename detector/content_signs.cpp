#include "detector/content_signs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fathom {
namespace {

/// Sums over pixels of the infrared image.
struct Brightness {
  int pixels = 0, measured = 0;
  double sum = 0.0, squares = 0.0;

  void add(double value, bool is_measured) {
    ++pixels;
    measured += is_measured;
    sum += value;
    squares += value * value;
  }
  double mean() const { return sum / pixels; }
  double contrast() const { return std::sqrt(std::max(0.0, squares / pixels - mean() * mean())) / mean(); }
  double matched() const { return static_cast<double>(measured) / pixels; }
};

/// The pixels around a vessel and where they look.
class View {
 public:
  View(const Cloud& cloud, const Pinhole& pinhole, const Eigen::Isometry3d& desk_from_camera, const RoundWall& wall)
      : cloud_(cloud), pinhole_(pinhole), camera_(desk_from_camera.translation()), wall_(wall) {
    turn_ = desk_from_camera.linear();
    const Eigen::Vector3d foot =
        desk_from_camera.inverse() * Eigen::Vector3d(wall.center.x(), wall.center.y(), 0.5 * wall.top_m);
    if (!(foot.z() > 0.0)) return;
    const double reach = pinhole.focal_x_px * (wall.radius_at(wall.top_m) + wall.top_m + kDeskOuter) / foot.z();
    const double column = pinhole.focal_x_px * foot.x() / foot.z() + pinhole.center_x_px;
    const double row = pinhole.focal_y_px * foot.y() / foot.z() + pinhole.center_y_px;
    const auto within = [](double value, int size) {
      return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    left_ = within(column - reach, cloud.width), right_ = within(column + reach, cloud.width);
    top_ = within(row - reach, cloud.height), bottom_ = within(row + reach, cloud.height);
  }

  /// Free of the rim and the wall, if a surface stood at that height.
  Brightness inside(double level_m, double margin_m) const {
    const double rim = wall_.radius_at(wall_.top_m) - margin_m, wall = wall_.radius_at(level_m) - margin_m;
    return sum([&](const Eigen::Vector3d& sight) {
      return at(sight, wall_.top_m).norm() < rim && at(sight, level_m).norm() < wall;
    });
  }
  Brightness albedo_of_surface(double level_m, double margin_m) const {
    constexpr double kLevel = 0.004;
    return albedo([&](const Eigen::Vector3d& point, const Eigen::Vector3d& sight) {
      const double from_axis = (point.head<2>() - wall_.center).norm();
      const bool counts = std::abs(point.z() - level_m) < kLevel && from_axis < wall_.radius_at(level_m) - margin_m;
      return counts ? -sight.z() : 0.0;
    });
  }
  /// The far inside of the wall, where it is seen and lit from the front.
  Brightness albedo_of_wall(double low_m, double margin_m) const {
    constexpr double kOnWall = 0.004, kSquarely = 0.3;
    return albedo([&](const Eigen::Vector3d& point, const Eigen::Vector3d& sight) {
      const Eigen::Vector2d outward = point.head<2>() - wall_.center;
      const bool counts = point.z() > low_m && point.z() < wall_.top_m - margin_m &&
                          std::abs(outward.norm() - wall_.radius_at(point.z())) < kOnWall;
      const double cosine = sight.head<2>().dot(outward.normalized());
      return counts && cosine > kSquarely ? cosine : 0.0;
    });
  }
  /// A strip of the desk in front, where the vessel neither hides nor shades it.
  Brightness desk() const {
    const double low = wall_.radius_m + kDeskInner, high = wall_.radius_m + kDeskOuter;
    return sum([&](const Eigen::Vector3d& sight) {
      const Eigen::Vector2d off = at(sight, 0.0);
      return off.norm() > low && off.norm() < high && off.dot(wall_.center) < 0.0;
    });
  }

 private:
  static constexpr double kDeskInner = 0.02, kDeskOuter = 0.06;

  /// From the axis to where a line of sight meets a height.
  Eigen::Vector2d at(const Eigen::Vector3d& sight, double height_m) const {
    return (camera_ + sight * ((height_m - camera_.z()) / sight.z())).head<2>() - wall_.center;
  }
  /// Of the measured points: the infrared image over the cosine of incidence and the squared range, as of dull
  /// surfaces. `cosine_of(point, sight)`: 0 where the point does not count.
  template <class Cosine>
  Brightness albedo(Cosine cosine_of) const {
    Brightness result;
    for (int y = top_; y < bottom_; ++y)
      for (int x = left_; x < right_; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * cloud_.width + x;
        if (!cloud_.points[pixel].allFinite() || !std::isfinite(cloud_.intensity[pixel])) continue;
        const Eigen::Vector3d way = turn_ * cloud_.points[pixel].cast<double>();
        const double cosine = cosine_of(Eigen::Vector3d(camera_ + way), Eigen::Vector3d(way.normalized()));
        if (cosine > 0.0) result.add(cloud_.intensity[pixel] * way.squaredNorm() / cosine, true);
      }
    return result;
  }
  template <class Looks>
  Brightness sum(Looks looks) const {
    Brightness result;
    for (int y = top_; y < bottom_; ++y)
      for (int x = left_; x < right_; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * cloud_.width + x;
        const Eigen::Vector3d sight = turn_ * pinhole_.sight(x, y);
        if (sight.z() < 0.0 && std::isfinite(cloud_.intensity[pixel]) && looks(sight))
          result.add(cloud_.intensity[pixel], cloud_.points[pixel].allFinite());
      }
    return result;
  }

  const Cloud& cloud_;
  const Pinhole& pinhole_;
  Eigen::Vector3d camera_;
  const RoundWall& wall_;
  Eigen::Matrix3d turn_;
  int left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
};

}  // namespace

ContentSigns content_signs(const Cloud& cloud, const Pinhole& pinhole, const Eigen::Isometry3d& desk_from_camera,
                           const RoundWall& wall, std::optional<double> level_m, const ContentSignSettings& settings) {
  if (cloud.intensity.size() != cloud.points.size()) return {};
  const View view(cloud, pinhole, desk_from_camera, wall);
  const Brightness desk = view.desk();
  if (desk.pixels < settings.pixels_min || !(desk.mean() > 0.0) || !(desk.contrast() > 0.0)) return {};

  const auto washed_out = [&](const Brightness& inside) {
    return inside.pixels >= settings.pixels_min && inside.mean() > settings.brightness_min * desk.mean() &&
           inside.contrast() < settings.contrast_max * desk.contrast();
  };
  const auto opaque = [&](const Brightness& inside) -> ContentSigns {
    return {settings.ratio, std::nullopt,
            fmt::format("dots inside have {:.0f} % of the desk's contrast, {:.0f} % are matched",
                        100.0 * inside.contrast() / desk.contrast(), 100.0 * inside.matched())};
  };
  if (level_m) {
    const Brightness inside = view.inside(*level_m, settings.margin_m);
    if (washed_out(inside)) return opaque(inside);
    const Brightness surface = view.albedo_of_surface(*level_m, settings.margin_m);
    const Brightness above = view.albedo_of_wall(*level_m + settings.margin_m, settings.margin_m);
    if (surface.pixels < settings.pixels_min || above.pixels < settings.pixels_min) return {};
    const double ratio = surface.mean() / above.mean();
    return {1.0, ratio, fmt::format("brightness inside is {:.2f} of the wall's", ratio)};
  }
  for (double level = settings.level_step_m; level < wall.top_m; level += settings.level_step_m) {
    const Brightness inside = view.inside(level, settings.margin_m);
    if (inside.pixels >= settings.pixels_min && inside.matched() < settings.matched_max && washed_out(inside))
      return opaque(inside);
  }
  return {};
}

}  // namespace fathom
