#include "sim/render/truth.h"

#include "core/parallel.h"
#include "sim/render/radiance.h"

namespace fathom {
namespace {

TruePixel trace_pixel(const PointLight& projector, const Rig& rig, double x_px, double y_px) {
  TruePixel pixel;
  const Ray chief{rig.camera_in_world(), rig.direction_in_world(x_px, y_px)};
  const std::optional<SeenPoint> seen = see(projector.world(), chief);
  if (!seen) return pixel;
  pixel.position = seen->point;
  pixel.object = seen->object;
  pixel.path = seen->entered ? PathKind::scattered : seen->refracted ? PathKind::refracted : PathKind::direct;
  const std::optional<Illumination> light = illuminate(projector, *seen);
  if (!light) return pixel;
  pixel.apparent_depth = triangulated_depth(rig, chief.direction, light->direction);
  pixel.intensity = radiance_dn(rig.sensor, *seen, *light);
  return pixel;
}

}  // namespace

std::optional<Eigen::Vector2d> rectified(const Rig& rig, const Eigen::Vector3d& direction_in_world) {
  const Eigen::Vector3d in_camera = rig.world_from_camera.linear().transpose() * direction_in_world;
  if (in_camera.z() <= 0.0) return std::nullopt;
  return in_camera.head<2>() / in_camera.z();
}

std::optional<double> triangulated_depth(const Rig& rig, const Eigen::Vector3d& camera_direction,
                                         const Eigen::Vector3d& projector_direction) {
  const auto seen = rectified(rig, camera_direction), sent = rectified(rig, projector_direction);
  if (!seen || !sent || seen->x() <= sent->x()) return std::nullopt;
  return rig.sensor.baseline / (seen->x() - sent->x());
}

Image<TruePixel> trace_truth(const PointLight& projector, const Rig& rig) {
  Image<TruePixel> truth(rig.sensor.width, rig.sensor.height);
  parallel_ranges(truth.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < truth.width(); ++x) truth(x, y) = trace_pixel(projector, rig, x + 0.5, y + 0.5);
  });
  return truth;
}

}  // namespace fathom
