// Vessels of known volume as meshes.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "sim/scene/mesh.h"

namespace fathom {

inline constexpr int kVesselFacets = 128;

/// A regular polygon's area over its circumscribed circle's: what faceting takes from every level section.
inline double vessel_facet_factor() {
  const double angle = 2.0 * std::numbers::pi / kVesselFacets;
  return std::sin(angle) / angle;
}

/// A single sheet: a profile (radius, height) [m] turned about the z axis.
inline Mesh sheet_of_revolution(const std::vector<Eigen::Vector2d>& profile, int facets = kVesselFacets) {
  Mesh mesh;
  for (const Eigen::Vector2d& point : profile)
    for (int facet = 0; facet < facets; ++facet) {
      const double angle = 2.0 * std::numbers::pi * facet / facets;
      mesh.add_vertex({point.x() * std::cos(angle), point.x() * std::sin(angle), point.y()});
    }
  for (int ring = 0; ring + 1 < static_cast<int>(profile.size()); ++ring)
    for (int facet = 0; facet < facets; ++facet) {
      const int next = (facet + 1) % facets, low = ring * facets, high = low + facets;
      if (profile[ring].x() > 0.0) mesh.add_triangle(low + facet, low + next, high + next);
      if (profile[ring + 1].x() > 0.0) mesh.add_triangle(low + facet, high + next, high + facet);
    }
  return mesh;
}

/// A torus about an axis along y through `centre`: a mug's handle.
inline Mesh torus(const Eigen::Vector3d& centre, double radius, double tube) {
  constexpr int kAlong = 48, kAround = 16;
  Mesh mesh;
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAround; ++j) {
      const double u = 2.0 * std::numbers::pi * i / kAlong, v = 2.0 * std::numbers::pi * j / kAround;
      const double reach = radius + tube * std::cos(v);
      mesh.add_vertex(centre + Eigen::Vector3d(reach * std::cos(u), tube * std::sin(v), reach * std::sin(u)));
    }
  const auto at = [](int i, int j) { return i % kAlong * kAround + j % kAround; };
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAround; ++j) {
      mesh.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

}  // namespace fathom
