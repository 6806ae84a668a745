#include "sim/render/polish.h"

#include <Eigen/Geometry>
#include <cmath>

#include "sim/optics/ray_differential.h"

namespace fathom {
namespace {

/// Corners, normals there, and how the barycentric weights change with the place, for a triangle with vertex normals.
struct SmoothTriangle {
  SmoothTriangle(const Mesh& mesh, const VertexNormals& shape, unsigned triangle, const Eigen::Vector3d& point) {
    const Eigen::Vector3i& corner = mesh.triangles[triangle];
    const Eigen::Vector3d& a = mesh.vertices[corner[0]];
    const Eigen::Vector3d ab = mesh.vertices[corner[1]] - a, ac = mesh.vertices[corner[2]] - a;
    const Eigen::Vector3d area = ab.cross(ac);
    const Eigen::Vector3d of_b = ac.cross(area) / area.squaredNorm(), of_c = area.cross(ab) / area.squaredNorm();
    const double b = of_b.dot(point - a), c = of_c.dot(point - a);
    const Eigen::Vector3d &na = shape.normals[corner[0]], &nb = shape.normals[corner[1]],
                          &nc = shape.normals[corner[2]];
    normal = (1.0 - b - c) * na + b * nb + c * nc;
    derivative = (nb - na) * of_b.transpose() + (nc - na) * of_c.transpose();
  }

  Eigen::Vector3d normal;      ///< not of unit length
  Eigen::Matrix3d derivative;  ///< of it by the place
};

struct Polish {
  const Surface& surface;
  unsigned triangle;
  const Eigen::Vector3d& facet_normal;
  const Ray& ray;
  double distance;

  std::optional<SurfacePoint> operator()(const Facets&) const { return SurfacePoint{distance, facet_normal}; }

  std::optional<SurfacePoint> operator()(const VertexNormals& shape) const {
    const SmoothTriangle smooth(surface.mesh, shape, triangle, ray.origin + distance * ray.direction);
    const Eigen::Vector3d normal = smooth.normal.normalized();
    // Near the outline an interpolated normal may look away from a ray that the triangle itself faces.
    const bool agrees = normal.dot(ray.direction) * facet_normal.dot(ray.direction) > 0.0;
    return SurfacePoint{distance, agrees ? normal : facet_normal};
  }

  template <class Smooth>
  std::optional<SurfacePoint> operator()(const Smooth& shape) const {
    constexpr double kReach = 5e-4;     // [m] far beyond what triangles of 0.25 mm stand off the surface, at any angle
    constexpr double kLastStep = 1e-9;  // [m] after it a surface bent with a radius of 1 mm is 1e-15 m away
    double t = distance;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Implicit at = implicit(shape, ray.origin + t * ray.direction);
      const double slope = at.gradient.dot(ray.direction);
      const double step = at.value / slope;
      t -= step;
      if (!(std::fabs(t - distance) < kReach)) return std::nullopt;
      if (std::fabs(step) > kLastStep) continue;
      const Eigen::Vector3d normal = (at.gradient - step * (at.hessian * ray.direction)).normalized();
      return SurfacePoint{t, normal.dot(facet_normal) < 0.0 ? Eigen::Vector3d(-normal) : normal};
    }
    return std::nullopt;
  }
};

struct OutwardCurvature {
  const Surface& surface;
  unsigned triangle;
  const Eigen::Vector3d& point;

  Eigen::Matrix3d operator()(const Facets&) const { return Eigen::Matrix3d::Zero(); }

  Eigen::Matrix3d operator()(const VertexNormals& shape) const {
    const SmoothTriangle smooth(surface.mesh, shape, triangle, point);
    return surface_frame(smooth.normal, smooth.derivative).curvature;
  }

  template <class Smooth>
  Eigen::Matrix3d operator()(const Smooth& shape) const {
    const Implicit at = implicit(shape, point);
    const Eigen::Vector3i& corner = surface.mesh.triangles[triangle];
    const Eigen::Vector3d& a = surface.mesh.vertices[corner[0]];
    const Eigen::Vector3d outward = (surface.mesh.vertices[corner[1]] - a).cross(surface.mesh.vertices[corner[2]] - a);
    const Eigen::Matrix3d curvature = surface_frame(at.gradient, at.hessian).curvature;
    return at.gradient.dot(outward) < 0.0 ? Eigen::Matrix3d(-curvature) : curvature;
  }
};

}  // namespace

std::optional<SurfacePoint> polish(const Surface& surface, unsigned triangle, const Eigen::Vector3d& facet_normal,
                                   const Ray& ray, double distance) {
  return std::visit(Polish{surface, triangle, facet_normal, ray, distance}, surface.shape);
}

Eigen::Matrix3d outward_curvature(const Surface& surface, unsigned triangle, const Eigen::Vector3d& point) {
  return std::visit(OutwardCurvature{surface, triangle, point}, surface.shape);
}

}  // namespace fathom
