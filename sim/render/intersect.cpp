#include "sim/render/intersect.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>
#include <vector>

#include "sim/render/crossing.h"
#include "sim/render/polish.h"

namespace fathom {
namespace {

struct Plane {
  Eigen::Vector3d normal;
  double offset;  ///< normal · x = offset on the plane
};

/// Which rays of a packet Embree is to trace.
struct Lanes {
  alignas(32) int valid[kPacket] = {};
};

void set_lane(Lanes& lanes, RTCRay8& rays, std::size_t i, const RTCRay& ray) {
  lanes.valid[i] = -1;
  rays.org_x[i] = ray.org_x, rays.org_y[i] = ray.org_y, rays.org_z[i] = ray.org_z;
  rays.dir_x[i] = ray.dir_x, rays.dir_y[i] = ray.dir_y, rays.dir_z[i] = ray.dir_z;
  rays.tnear[i] = ray.tnear, rays.tfar[i] = ray.tfar;
  rays.time[i] = ray.time, rays.mask[i] = ray.mask, rays.flags[i] = ray.flags;
}

}  // namespace

struct Intersector::Impl {
  RTCDevice device = nullptr;
  RTCScene all = nullptr;                  ///< every surface
  RTCScene opaque = nullptr;               ///< opaque surfaces
  RTCScene clear = nullptr;                ///< boundaries of clear bodies
  std::vector<const Surface*> surfaces;    ///< by Embree's geometry id, the same in all scenes
  std::vector<std::vector<Plane>> planes;  ///< by geometry id and primitive id

  ~Impl() {
    rtcReleaseScene(all);
    rtcReleaseScene(opaque);
    rtcReleaseScene(clear);
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
    rtcAttachGeometryByID(std::holds_alternative<Interface>(surface.optics) ? clear : opaque, geometry, id);
    rtcReleaseGeometry(geometry);
    surfaces.push_back(&surface);
    planes.push_back(std::move(of_triangles));
  }

  static RTCIntersectContext coherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
  }

  static RTCRay embree_ray(const Ray& ray, double near, double far) {
    RTCRay result;
    result.org_x = static_cast<float>(ray.origin.x());
    result.org_y = static_cast<float>(ray.origin.y());
    result.org_z = static_cast<float>(ray.origin.z());
    result.dir_x = static_cast<float>(ray.direction.x());
    result.dir_y = static_cast<float>(ray.direction.y());
    result.dir_z = static_cast<float>(ray.direction.z());
    result.tnear = static_cast<float>(near);
    result.tfar = static_cast<float>(far);
    result.time = 0.0f;
    result.mask = ~0u;
    result.flags = 0;
    return result;
  }

  /// Where the ray meets the shape that the triangle stands for. Nothing where it passes by, and where it starts: rays
  /// that start on a surface may meet it once more, rounded to float at a grazing angle, or as triangles of a smooth
  /// one.
  std::optional<Hit> hit_on(unsigned geometry, unsigned triangle, const Ray& ray) const {
    const Surface& surface = *surfaces[geometry];
    const Plane& plane = planes[geometry][triangle];
    const double facing = plane.normal.dot(ray.direction);
    if (facing == 0.0) return std::nullopt;
    const double distance = (plane.offset - plane.normal.dot(ray.origin)) / facing;
    const std::optional<SurfacePoint> at = std::holds_alternative<Facets>(surface.shape)
                                               ? SurfacePoint{distance, plane.normal}
                                               : polish(surface, triangle, plane.normal, ray, distance);
    if (!at || at->distance <= kClearance) return std::nullopt;
    const bool entering = at->normal.dot(ray.direction) < 0.0;
    return Hit{at->distance,
               ray.origin + at->distance * ray.direction,
               entering ? at->normal : Eigen::Vector3d(-at->normal),
               &surface,
               triangle,
               entering};
  }

  static RTCRay embree_ray(const Piece& piece) {
    return embree_ray({piece.from, piece.direction}, kClearance, piece.length - kClearance);
  }

  std::optional<Hit> trace(RTCScene scene, const Ray& ray, double near = kClearance) const {
    RTCIntersectContext context = coherent();
    for (;;) {
      RTCRayHit query;
      query.ray = embree_ray(ray, near, std::numeric_limits<float>::infinity());
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
      if (const std::optional<Hit> hit = hit_on(query.hit.geomID, query.hit.primID, ray)) return hit;
      near = std::max<double>(query.ray.tfar, near) + kClearance;
    }
  }

  static bool hits(RTCScene scene, const Piece& piece) {
    RTCIntersectContext context = coherent();
    RTCRay ray = embree_ray(piece);
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0.0f;
  }

  static std::bitset<kPacket> hits(RTCScene scene, const Packet<Piece>& pieces) {
    std::bitset<kPacket> result;
    if (!pieces.is_several()) {  // alone it is cheaper by itself
      for (std::size_t i = 0; i < kPacket; ++i)
        if (const Piece* piece = pieces.find(i)) result[i] = hits(scene, *piece);
      return result;
    }
    RTCIntersectContext context = coherent();
    Lanes lanes;
    RTCRay8 query;
    for (std::size_t i = 0; i < kPacket; ++i)
      if (const Piece* piece = pieces.find(i)) set_lane(lanes, query, i, embree_ray(*piece));
    rtcOccluded8(lanes.valid, scene, &context, &query);
    for (std::size_t i = 0; i < kPacket; ++i) result[i] = lanes.valid[i] && query.tfar[i] < 0.0f;
    return result;
  }

  static constexpr double kClearance = Intersector::kClearance;
};

Intersector::Intersector(const Geometry& geometry)
    : geometry_(geometry),
      level_liquids_only_(
          std::all_of(geometry.bodies.begin(), geometry.bodies.end(), [](const Body& body) { return body.plain; })),
      impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  if (!impl_->device) throw std::runtime_error("Embree cannot start on this machine");
  for (RTCScene* scene : {&impl_->all, &impl_->opaque, &impl_->clear}) {
    *scene = rtcNewScene(impl_->device);
    rtcSetSceneFlags(*scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips between two triangles
    rtcSetSceneBuildQuality(*scene, RTC_BUILD_QUALITY_HIGH);
  }
  for (const Surface& surface : geometry.surfaces) impl_->attach(surface);
  for (RTCScene scene : {impl_->all, impl_->opaque, impl_->clear}) rtcCommitScene(scene);
}

Intersector::~Intersector() = default;

std::optional<Hit> Intersector::first_hit(const Ray& ray) const { return impl_->trace(impl_->all, ray); }

std::optional<Hit> Intersector::first_interface(const Ray& ray) const { return impl_->trace(impl_->clear, ray); }

std::optional<Hit> Intersector::first_opaque(const Ray& ray) const { return impl_->trace(impl_->opaque, ray); }

Packet<Hit> Intersector::first_hits(std::span<const Ray> rays) const {
  assert(rays.size() <= kPacket);
  RTCIntersectContext context = Impl::coherent();
  Lanes lanes;
  RTCRayHit8 query;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    set_lane(lanes, query.ray, i, Impl::embree_ray(rays[i], kClearance, std::numeric_limits<float>::infinity()));
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect8(lanes.valid, impl_->all, &context, &query);
  Packet<Hit> hits;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    if (const auto hit = impl_->hit_on(query.hit.geomID[i], query.hit.primID[i], rays[i]))
      hits.set(i, *hit);
    else if (const auto next =
                 impl_->trace(impl_->all, rays[i], std::max<double>(query.ray.tfar[i], kClearance) + kClearance))
      hits.set(i, *next);
  }
  return hits;
}

bool Intersector::occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const Eigen::Vector3d path = to - from;
  const double length = path.norm();
  return Impl::hits(impl_->opaque, Piece{from, path / length, length});
}

std::bitset<kPacket> Intersector::occluded(const Packet<Piece>& pieces) const {
  return Impl::hits(impl_->opaque, pieces);
}

std::bitset<kPacket> Intersector::interrupted(const Packet<Piece>& pieces) const {
  return Impl::hits(impl_->all, pieces);
}

Eigen::Matrix3d Intersector::curvature(const Hit& hit) const {
  const Eigen::Matrix3d outward = outward_curvature(*hit.surface, hit.triangle, hit.point);
  return hit.entering ? outward : Eigen::Matrix3d(-outward);
}

BodySet Intersector::bodies_around(const Eigen::Vector3d& point) const {
  std::vector<Hit> above;
  Ray up{point, Eigen::Vector3d::UnitZ()};
  while (const std::optional<Hit> hit = first_interface(up)) {
    above.push_back(*hit);
    up.origin = hit->point;
  }
  BodySet around = 0;
  for (auto hit = above.rbegin(); hit != above.rend(); ++hit) {
    hit->entering = !hit->entering;
    around = beyond(*hit, around);
  }
  return around;
}

}  // namespace fathom
