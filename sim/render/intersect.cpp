#include "sim/render/intersect.h"

#include <embree3/rtcore.h>

#include <limits>
#include <stdexcept>
#include <vector>

namespace fathom {
namespace {

struct Plane {
  Eigen::Vector3d normal;
  double offset;  ///< normal · x = offset on the plane
};

}  // namespace

struct Intersector::Impl {
  RTCDevice device = nullptr;
  RTCScene all = nullptr;                  ///< every surface
  RTCScene opaque = nullptr;               ///< without the liquids' surfaces
  std::vector<const Surface*> surfaces;    ///< by Embree's geometry id, the same in both scenes
  std::vector<std::vector<Plane>> planes;  ///< by geometry id and primitive id

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
    std::vector<Plane> of_triangles;
    of_triangles.reserve(mesh.triangles.size());
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      for (int corner = 0; corner < 3; ++corner) *corners++ = static_cast<unsigned>(triangle[corner]);
      const Eigen::Vector3d& a = mesh.vertices[triangle[0]];
      const Eigen::Vector3d normal =
          (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a).normalized();
      of_triangles.push_back({normal, normal.dot(a)});
    }
    rtcCommitGeometry(geometry);
    const auto id = static_cast<unsigned>(surfaces.size());
    rtcAttachGeometryByID(all, geometry, id);
    if (std::holds_alternative<Diffuse>(surface.optics)) rtcAttachGeometryByID(opaque, geometry, id);
    rtcReleaseGeometry(geometry);
    surfaces.push_back(&surface);
    planes.push_back(std::move(of_triangles));
  }

  std::optional<Hit> trace(RTCScene scene, const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit query;
    query.ray.org_x = static_cast<float>(ray.origin.x());
    query.ray.org_y = static_cast<float>(ray.origin.y());
    query.ray.org_z = static_cast<float>(ray.origin.z());
    query.ray.dir_x = static_cast<float>(ray.direction.x());
    query.ray.dir_y = static_cast<float>(ray.direction.y());
    query.ray.dir_z = static_cast<float>(ray.direction.z());
    query.ray.tnear = static_cast<float>(kClearance);
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.time = 0.0f;
    query.ray.mask = ~0u;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const Plane& plane = planes[query.hit.geomID][query.hit.primID];
    const double facing = plane.normal.dot(ray.direction);
    if (facing == 0.0) return std::nullopt;
    Hit hit;
    hit.distance = (plane.offset - plane.normal.dot(ray.origin)) / facing;
    hit.point = ray.origin + hit.distance * ray.direction;
    hit.normal = facing < 0.0 ? plane.normal : Eigen::Vector3d(-plane.normal);
    hit.surface = surfaces[query.hit.geomID];
    return hit;
  }
};

Intersector::Intersector(const Geometry& geometry) : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  if (!impl_->device) throw std::runtime_error("Embree cannot start on this machine");
  impl_->all = rtcNewScene(impl_->device);
  impl_->opaque = rtcNewScene(impl_->device);
  for (RTCScene scene : {impl_->all, impl_->opaque}) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips between two triangles
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  }
  for (const Surface& surface : geometry.surfaces) impl_->attach(surface);
  rtcCommitScene(impl_->all);
  rtcCommitScene(impl_->opaque);
}

Intersector::~Intersector() = default;

std::optional<Hit> Intersector::first_hit(const Ray& ray) const { return impl_->trace(impl_->all, ray); }

std::optional<Hit> Intersector::first_opaque_hit(const Ray& ray) const { return impl_->trace(impl_->opaque, ray); }

bool Intersector::occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const Eigen::Vector3d path = to - from;
  const double length = path.norm();
  const Eigen::Vector3d direction = path / length;
  RTCRay ray;
  ray.org_x = static_cast<float>(from.x());
  ray.org_y = static_cast<float>(from.y());
  ray.org_z = static_cast<float>(from.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = static_cast<float>(kClearance);
  ray.tfar = static_cast<float>(length - kClearance);
  ray.time = 0.0f;
  ray.mask = ~0u;
  ray.flags = 0;
  rtcOccluded1(impl_->opaque, &context, &ray);
  return ray.tfar < 0.0f;
}

}  // namespace fathom
