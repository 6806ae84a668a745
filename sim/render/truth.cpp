#include "sim/render/truth.h"

#include <algorithm>

#include "core/parallel.h"
#include "sim/render/radiance.h"

namespace fathom {

PathKind path_of(const SeenPoint& seen) {
  return seen.entered ? PathKind::scattered : seen.refracted ? PathKind::refracted : PathKind::direct;
}

namespace {

/// The pixels from (x, y) on to the right.
void trace_packet(const PointLight& projector, const Rig& rig, int x, int y, std::span<TruePixel> pixels) {
  std::array<Ray, kPacket> chiefs;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    chiefs[i] = {rig.camera_in_world(), rig.direction_in_world(x + static_cast<int>(i) + 0.5, y + 0.5)};
  Packet<Hit> first;
  const Packet<SeenPoint> seen = see(projector.world(), std::span(chiefs).first(pixels.size()), &first);
  const Packet<Illumination> lights = illuminate(projector, seen);
  const Eigen::Vector3d forward = rig.world_from_camera.linear().col(2);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    TruePixel& pixel = pixels[i];
    if (const Hit* met = first.find(i)) {
      pixel.first_object = met->surface->object;
      pixel.first_depth = forward.dot(met->point - rig.camera_in_world());
    }
    const SeenPoint* at = seen.find(i);
    if (!at) continue;
    pixel.position = at->point;
    pixel.object = at->object;
    pixel.path = path_of(*at);
    const Illumination* light = lights.find(i);
    if (!light) continue;
    pixel.apparent_depth = triangulated_depth(rig, chiefs[i].direction, light->direction);
    pixel.intensity = static_cast<float>(radiance_dn(rig.sensor, *at, *light));
  }
}

}  // namespace

std::optional<double> triangulated_depth(const Rig& rig, const Eigen::Vector3d& camera_direction,
                                         const Eigen::Vector3d& projector_direction) {
  const auto seen = rig.rectified(camera_direction), sent = rig.rectified(projector_direction);
  if (!seen || !sent || seen->x() <= sent->x()) return std::nullopt;
  return rig.sensor.baseline / (seen->x() - sent->x());
}

Image<TruePixel> trace_truth(const PointLight& projector, const Rig& rig) {
  Image<TruePixel> truth(rig.sensor.width, rig.sensor.height);
  parallel_rows(truth.height(), [&](int y) {
    for (int x = 0; x < truth.width(); x += kPacket) {
      const std::size_t count = std::min<std::size_t>(kPacket, truth.width() - x);
      trace_packet(projector, rig, x, y, {&truth(x, y), count});
    }
  });
  return truth;
}
static_assert(sizeof(TruePixel) == 64);

}  // namespace fathom
