#include "tests/sensor/exact_dot.h"

#include <cmath>
#include <numbers>

#include "sim/optics/fresnel.h"
#include "theory/triangulation.h"

namespace fathom {
namespace {

double angle_in_liquid(double angle, const Ground& ground) { return std::asin(std::sin(angle) / ground.index); }

/// Where light from above at an angle of incidence gets to, from below its source.
double horizontal_reach(double height, double angle, const Ground& ground) {
  return height * std::tan(angle) + ground.fill * std::tan(angle_in_liquid(angle, ground));
}

/// Solid angle at a source in the air per area of level ground that its light falls on [1/m²]: sin θ dθ dφ over
/// r dr dφ, with r(θ) the reach.
double solid_angle_per_area(double height, double angle, const Ground& ground) {
  const double cosine = std::cos(angle), cos_in_liquid = std::cos(angle_in_liquid(angle, ground));
  const double slope =
      height / (cosine * cosine) + ground.fill * cosine / (ground.index * std::pow(cos_in_liquid, 3.0));
  return std::sin(angle) / (horizontal_reach(height, angle, ground) * slope);
}

/// Share of the power that the surface and the liquid let through, one way.
double let_through(double angle, const Ground& ground) {
  const double path = ground.fill / std::cos(angle_in_liquid(angle, ground));
  return (1.0 - fresnel_reflectance(std::cos(angle), 1.0, ground.index)) * std::exp(-ground.absorption * path);
}

/// The point of the ground that the projector's ray gets to, from below the projector.
Eigen::Vector2d landing(const Eigen::Vector3d& sent, double angle, double height, const Ground& ground) {
  return sent.head<2>().normalized() * horizontal_reach(height, angle, ground);
}

theory::Triangulation triangulation(const Rig& rig, const Eigen::Vector2d& point, const Ground& ground) {
  return theory::triangulate({.sensor_height = rig.camera_in_world().z() - ground.z,
                              .baseline = rig.sensor.baseline,
                              .fill = ground.fill,
                              .index = ground.index,
                              .lateral = point.x(),
                              .distance = point.y(),
                              .pitch = std::asin(-rig.world_from_camera.linear().col(2).z()),
                              .focal_px = rig.sensor.focal_px});
}

}  // namespace

DotImage exact_dot(const Rig& rig, const Eigen::Vector2d& direction, const Ground& ground) {
  const SensorModel& sensor = rig.sensor;
  const Eigen::Matrix3d world_from_camera = rig.world_from_camera.linear();
  const Eigen::Vector3d projector = rig.projector_in_world(), camera = rig.camera_in_world();
  const double height = camera.z() - ground.z - ground.fill;  // above the surface
  const Eigen::Vector3d sent = (world_from_camera * direction.homogeneous()).normalized();
  const double sent_angle = std::acos(-sent.z());
  const Eigen::Vector2d point = projector.head<2>() + landing(sent, sent_angle, height, ground);

  const theory::Triangulation seen = triangulation(rig, point, ground);
  const Eigen::Vector3d measured = seen.measured + Eigen::Vector3d(0.0, 0.0, ground.z);
  const Eigen::Vector3d sight = (world_from_camera.transpose() * (measured - camera)).normalized();
  const Eigen::Vector2d image_px = sensor.principal_px + sensor.focal_px * sight.hnormalized();

  // What the ground returns of the dot's power per solid angle is albedo / π of it, by Lambert; 1 / n² of that radiance
  // is left in the air, and the pixels that see it span the solid angle of the dot's area at the camera.
  const double returned = ground.albedo * let_through(sent_angle, ground) * let_through(seen.incidence_camera, ground) /
                          (ground.index * ground.index) * solid_angle_per_area(height, seen.incidence_camera, ground);
  // The pattern and the image are planes: a solid angle is cos³ of an area on either.
  const double planes = std::pow(direction.homogeneous().normalized().z() / sight.z(), 3.0);
  const double area_ir_px2 = 2.0 * std::numbers::pi * std::pow(sensor.pattern.dot_sigma_ir_px, 2.0);
  constexpr double kSquareMetresPerSquareMm = 1e-6;
  return {sensor.ir_scale() * image_px + Eigen::Vector2d(0.0, sensor.ir_first_row()),
          sensor.radiant_dn_mm2 * kSquareMetresPerSquareMm * returned * planes * area_ir_px2};
}

}  // namespace fathom
