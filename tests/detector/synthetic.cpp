#include "tests/detector/synthetic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cloud_file.h"
#include "core/pose.h"
#include "core/rng.h"

namespace fathom::synthetic {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Smallest distance along the ray to the horizontal plane z = height where `inside(point)`.
template <class Inside>
double hit_level(const Ray& ray, double height, Inside inside) {
  const double t = (height - ray.origin.z()) / ray.direction.z();
  return t > 0.0 && inside(Eigen::Vector3d(ray.origin + t * ray.direction)) ? t : kNothing;
}

/// Distances to both walls of a vertical cylinder, where they are between the two heights.
double hit_cylinder(const Ray& ray, const OpenCup& cup, double radius, double low, double high) {
  const Eigen::Vector2d from = ray.origin.head<2>() - Eigen::Vector2d(cup.x_m, cup.y_m),
                        along = ray.direction.head<2>();
  const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius * radius;
  if (b * b - a * c <= 0.0) return kNothing;
  double nearest = kNothing;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (-b + sign * std::sqrt(b * b - a * c)) / a;
    const double z = ray.origin.z() + t * ray.direction.z();
    if (t > 0.0 && z >= low && z <= high) nearest = std::min(nearest, t);
  }
  return nearest;
}

/// Nearest distance to z = floor + slope · (inner radius − distance from the axis), the surface of a mound.
double hit_mound(const Ray& ray, const OpenCup& cup) {
  const Eigen::Vector2d from = ray.origin.head<2>() - Eigen::Vector2d(cup.x_m, cup.y_m),
                        along = ray.direction.head<2>();
  const double below_tip = cup.floor_m + cup.mound_slope * cup.inner_radius_m - ray.origin.z();
  const double steep = cup.mound_slope * cup.mound_slope, down = -ray.direction.z();
  // (tip − z)² = slope² · distance², with tip − z above 0: the cone below its tip.
  const double a = down * down - steep * along.squaredNorm(), b = below_tip * down - steep * from.dot(along),
               c = below_tip * below_tip - steep * from.squaredNorm();
  if (b * b - a * c < 0.0) return kNothing;
  double nearest = kNothing;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (-b + sign * std::sqrt(b * b - a * c)) / a;
    if (t > 0.0 && below_tip + t * down >= 0.0 && (from + t * along).norm() < cup.inner_radius_m)
      nearest = std::min(nearest, t);
  }
  return nearest;
}

/// Distance to the floor, which may lean.
double hit_floor(const Ray& ray, const OpenCup& cup) {
  const Eigen::Vector3d up(0.0, -cup.lean_slope, 1.0);
  const Eigen::Vector3d on_floor(cup.x_m, cup.y_m, cup.floor_m);
  const double t = up.dot(on_floor - ray.origin) / up.dot(ray.direction);
  const Eigen::Vector2d at = (ray.origin + t * ray.direction).head<2>();
  return t > 0.0 && (at - on_floor.head<2>()).norm() < cup.inner_radius_m ? t : kNothing;
}

double hit_cup(const Ray& ray, const OpenCup& cup) {
  const auto distance = [&](const Eigen::Vector3d& p) { return std::hypot(p.x() - cup.x_m, p.y() - cup.y_m); };
  const double rim = hit_level(ray, cup.height_m, [&](const Eigen::Vector3d& p) {
    return distance(p) >= cup.inner_radius_m && distance(p) <= cup.outer_radius_m;
  });
  const double floor = cup.mound_slope > 0.0 ? hit_mound(ray, cup) : hit_floor(ray, cup);
  const double outside = hit_cylinder(ray, cup, cup.outer_radius_m, 0.0, cup.height_m);
  const double lowest = cup.floor_m - cup.lean_slope * cup.inner_radius_m;
  const double inside = hit_cylinder(ray, cup, cup.inner_radius_m, lowest, cup.height_m);
  return std::min(std::min(rim, floor), std::min(outside, inside));
}

double hit_box(const Ray& ray, const Box& box) {
  const Eigen::Array3d low(box.low.x(), box.low.y(), 0.0), high(box.high.x(), box.high.y(), box.height_m);
  const Eigen::Array3d a = (low - ray.origin.array()) / ray.direction.array();
  const Eigen::Array3d b = (high - ray.origin.array()) / ray.direction.array();
  const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
  return enter > 0.0 && enter <= leave ? enter : kNothing;
}

double nearest_hit(const Scene& scene, const Ray& ray) {
  double nearest = kNothing;
  if (scene.desk)
    nearest = hit_level(ray, 0.0,
                        [](const Eigen::Vector3d& p) { return std::abs(p.x()) < 0.7 && p.y() > 0.05 && p.y() < 1.05; });
  for (const OpenCup& cup : scene.cups) nearest = std::min(nearest, hit_cup(ray, cup));
  for (const Box& box : scene.boxes) nearest = std::min(nearest, hit_box(ray, box));
  return nearest;
}

Pose world_from_camera(const Scene& scene) {
  const DeskPrior level{scene.sensor.height_m, scene.sensor.pitch_rad, scene.sensor.roll_rad};
  return Eigen::AngleAxisd(scene.yaw_rad, Eigen::Vector3d::UnitZ()) * desk_from_camera(plane_from(level));
}

}  // namespace

Cloud cast(const Scene& scene) {
  const Pose from_camera = world_from_camera(scene);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Cloud cloud;
  cloud.width = scene.width;
  cloud.height = scene.height;
  Rng rng(scene.seed);
  for (int row = 0; row < scene.height; ++row) {
    for (int column = 0; column < scene.width; ++column) {
      const Eigen::Vector3d sight =
          Eigen::Vector3d(column + 0.5 - 0.5 * scene.width, row + 0.5 - 0.5 * scene.height, scene.focal_px)
              .normalized();
      const double hit = nearest_hit(scene, {from_camera.translation(), from_camera.linear() * sight});
      const double noisy = hit + (scene.noise_m > 0.0 ? scene.noise_m * rng.normal() : 0.0);
      if (hit < kNothing)
        cloud.points.push_back((noisy * sight).cast<float>());
      else
        cloud.points.push_back(Eigen::Vector3f::Constant(kNaN));
    }
  }
  return cloud;
}

void write_cup(const std::filesystem::path& path, double floor_m) {
  Scene scene;
  scene.cups = {OpenCup{}};
  scene.cups[0].floor_m = floor_m;
  const Cloud cloud = cast(scene);
  Image<CloudPoint> image(cloud.width, cloud.height);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    image.pixels()[i] = {cloud.points[i].x(), cloud.points[i].y(), cloud.points[i].z(), 0.0f};
  write_pcd(path, image);
}

void write_thinned_cup(const std::filesystem::path& path, double floor_m) {
  Scene scene;
  scene.cups = {OpenCup{}};
  scene.cups[0].floor_m = floor_m;
  scene.width = 640, scene.height = 480, scene.focal_px = 570.342;
  const Cloud cloud = cast(scene);
  std::vector<CloudPoint> kept;
  for (int row = 0; row < cloud.height; row += 2)
    for (int column = 0; column < cloud.width; column += 2) {
      const bool is_about_cup = std::max(std::abs(column - 320), std::abs(row - 240)) <= 60;
      if (!is_about_cup && (row % 16 != 0 || column % 16 != 0)) continue;
      const Eigen::Vector3f& point = cloud.points[static_cast<std::size_t>(row) * cloud.width + column];
      if (point.allFinite()) kept.push_back({point.x(), point.y(), point.z(), 0.0f});
    }
  Image<CloudPoint> image(static_cast<int>(kept.size()), 1);
  std::copy(kept.begin(), kept.end(), image.pixels().begin());
  write_pcd(path, image);
}

DeskPrior looking_at(double height_m, double distance_m) { return {height_m, std::atan2(height_m, distance_m), 0.0}; }

}  // namespace fathom::synthetic
