#include "bench/embree_loop.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <new>

#include "core/parallel.h"

namespace fathom {

struct EmbreeLoop::Impl {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene all = rtcNewScene(device);
  RTCScene opaque = rtcNewScene(device);

  ~Impl() {
    rtcReleaseScene(all);
    rtcReleaseScene(opaque);
    rtcReleaseDevice(device);
  }

  void attach(const Surface& surface) {
    const Mesh& mesh = surface.mesh;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.vertices.size()));
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), mesh.triangles.size()));
    if (!vertices || !corners) throw std::bad_alloc();
    for (const Eigen::Vector3d& vertex : mesh.vertices)
      for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(vertex[axis]);
    for (const Eigen::Vector3i& triangle : mesh.triangles)
      for (int corner = 0; corner < 3; ++corner) *corners++ = static_cast<unsigned>(triangle[corner]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(all, geometry);
    if (!std::holds_alternative<Interface>(surface.optics)) rtcAttachGeometry(opaque, geometry);
    rtcReleaseGeometry(geometry);
  }

  bool hits(const RecordedRay& recorded) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit query;
    query.ray = {recorded.origin[0],
                 recorded.origin[1],
                 recorded.origin[2],
                 static_cast<float>(Intersector::kClearance),
                 recorded.direction[0],
                 recorded.direction[1],
                 recorded.direction[2],
                 0.0f,
                 recorded.far,
                 ~0u,
                 0,
                 0};
    if (recorded.kind == RayKind::occluded) {
      rtcOccluded1(opaque, &context, &query.ray);
      return query.ray.tfar < 0.0f;
    }
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(all, &context, &query);
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
};

EmbreeLoop::EmbreeLoop(const Geometry& geometry) : impl_(std::make_unique<Impl>()) {
  for (RTCScene scene : {impl_->all, impl_->opaque}) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  }
  for (const Surface& surface : geometry.surfaces) impl_->attach(surface);
  rtcCommitScene(impl_->all);
  rtcCommitScene(impl_->opaque);
}

EmbreeLoop::~EmbreeLoop() = default;

std::uint64_t EmbreeLoop::trace(const Recording& recording) const {
  std::atomic<std::uint64_t> hits = 0;
  parallel_ranges(static_cast<int>(recording.rows.size()), [&](int begin, int end) {
    std::uint64_t hits_here = 0;
    for (int y = begin; y < end; ++y)
      hits_here += std::count_if(recording.rows[y].begin(), recording.rows[y].end(),
                                 [&](const RecordedRay& ray) { return impl_->hits(ray); });
    hits += hits_here;
  });
  return hits;
}

}  // namespace fathom
