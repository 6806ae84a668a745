#include "sim/render/overlap.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "core/error.h"
#include "sim/render/intersect.h"
#include "sim/scene/geometry.h"

namespace fathom {
namespace {

/// A cup or an object without anything around it.
class Thing {
 public:
  Thing(std::string place, const Geometry& all, int object, bool is_solid)
      : place_(std::move(place)), is_solid_(is_solid), geometry_(std::make_unique<Geometry>()) {
    geometry_->objects = all.objects;
    geometry_->bodies = all.bodies;
    for (const Surface& surface : all.surfaces) {
      if (surface.object != object) continue;
      geometry_->surfaces.push_back(surface);
      for (const Eigen::Vector3d& vertex : surface.mesh.vertices) box_.extend(vertex);
    }
  }

  const std::string& place() const { return place_; }
  const Eigen::AlignedBox3d& box() const { return box_; }

  bool crosses(const Thing& other, const Eigen::Vector3d& shift) const {
    return pierces(other, shift) || other.pierces(*this, -shift);
  }

  /// Whether this, which crosses the other nowhere, lies within its matter: a line up from its top comes out of it.
  bool is_inside(const Thing& other) const {
    if (!other.is_solid_ || !other.box_.contains(box_)) return false;
    Eigen::Vector3d top = box_.center();
    for (const Surface& surface : geometry_->surfaces)
      for (const Eigen::Vector3d& vertex : surface.mesh.vertices)
        if (vertex.z() > top.z()) top = vertex;
    const Eigen::Vector3d up = Eigen::Vector3d(0.013, 0.007, 1.0).normalized();  // along no edge of a box
    const auto hit = other.intersector().first_hit({top, up});
    return hit && !hit->entering;
  }

 private:
  /// Whether an edge of this, moved by `shift`, goes through a surface of the other.
  bool pierces(const Thing& other, const Eigen::Vector3d& shift) const {
    for (const Surface& surface : geometry_->surfaces)
      for (const Eigen::Vector3i& triangle : surface.mesh.triangles)
        for (int corner = 0; corner < 3; ++corner) {
          const Eigen::Vector3d from = surface.mesh.vertices[triangle[corner]] + shift,
                                along = surface.mesh.vertices[triangle[(corner + 1) % 3]] + shift - from;
          Eigen::AlignedBox3d edge(from);
          edge.extend(from + along);
          if (along.norm() == 0.0 || !edge.intersects(other.box_)) continue;
          const auto hit = other.intersector().first_hit({from, along.normalized()});
          if (hit && hit->distance < along.norm()) return true;
        }
    return false;
  }

  const Intersector& intersector() const {
    if (!intersector_) intersector_ = std::make_unique<Intersector>(*geometry_);
    return *intersector_;
  }

  std::string place_;
  bool is_solid_;
  std::unique_ptr<Geometry> geometry_;
  Eigen::AlignedBox3d box_;
  mutable std::unique_ptr<Intersector> intersector_;  // few things come near others
};

bool overlap(const Thing& one, const Thing& other) {
  if (!one.box().intersects(other.box())) return false;
  std::vector<Eigen::Vector3d> shifts{Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) shifts.emplace_back(sign * kTouching * Eigen::Vector3d::Unit(axis));
  return std::all_of(shifts.begin(), shifts.end(), [&](const auto& shift) { return one.crosses(other, shift); }) ||
         one.is_inside(other) || other.is_inside(one);
}

}  // namespace

std::optional<Overlap> find_overlap(const Scene& scene, double wavelength_nm) {
  const Geometry geometry = build_geometry(scene, wavelength_nm);
  std::vector<Thing> things;
  for (std::size_t i = 0; i < scene.cups.size(); ++i)
    things.emplace_back(fmt::format("/cups/{}", i), geometry, geometry.cups[i].cup, false);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    things.emplace_back(fmt::format("/objects/{}", i), geometry, geometry.things[i],
                        std::holds_alternative<Solid>(scene.objects[i].thing));
  for (std::size_t i = 0; i < things.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(things[i], things[j])) return Overlap{things[i].place(), things[j].place()};
  return std::nullopt;
}

void require_apart(const Setup& setup) {
  if (const auto overlap = find_overlap(setup.scene, setup.rig.sensor.wavelength_nm))
    throw Error(setup.file, overlap->one,
                fmt::format("stands in {}: things may touch, not share their room", overlap->other));
}

}  // namespace fathom
