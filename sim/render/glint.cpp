#include "sim/render/glint.h"

#include <Eigen/LU>
#include <algorithm>

namespace fathom {
namespace {

/// Rays from a source towards the triangles of clear bodies, and where they would have to go instead.
class Search {
 public:
  Search(const Intersector& world, const Source& source, const Eigen::Vector3d& eye)
      : world_(world), source_(source), eye_(eye) {}

  /// Sends a ray to the triangle's middle; shoots where a ray less than a few of its widths aside might reach the eye.
  void search(const Mesh& mesh, const Eigen::Vector3i& triangle) {
    const Eigen::Vector3d &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]],
                          &c = mesh.vertices[triangle[2]];
    const Eigen::Vector3d towards = (a + b + c) / 3.0 - source_.position;
    const double width = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}) / towards.norm();
    const Eigen::Vector3d direction = towards.normalized();
    constexpr int kLongestChain = 8;  // as light of all kinds
    Flight flight{pencil_from(source_.position, direction), source_.inside, 1.0};
    for (int crossings = 1; crossings <= kLongestChain; ++crossings) {
      const auto next = next_crossing(world_, {flight.pencil.origin, flight.pencil.direction}, flight.inside);
      if (!next) return;
      pass(world_, *next, crossings == 1 ? Event::reflect : Event::refract, flight);
      if (flight.inside == 0 && lands_within(kReach * width, flight.pencil))
        add_new(found, shoot(world_, source_, eye_, nullptr, direction, crossings, Event::reflect));
    }
  }

  std::vector<Connection> found;

 private:
  static constexpr double kReach = 3.0;

  bool lands_within(double angle, const Pencil& pencil) const {
    const Landing landing = land(pencil, eye_);
    return landing.distance > 0.0 && (landing.jacobian.inverse() * landing.miss).norm() < angle;
  }

  const Intersector& world_;
  const Source& source_;
  const Eigen::Vector3d& eye_;
};

}  // namespace

std::vector<Connection> find_glints(const Intersector& world, const Source& source, const Eigen::Vector3d& eye) {
  Search search(world, source, eye);
  for (const Surface& surface : world.geometry().surfaces)
    if (std::holds_alternative<Interface>(surface.optics))
      for (const Eigen::Vector3i& triangle : surface.mesh.triangles) search.search(surface.mesh, triangle);
  return std::move(search.found);
}

}  // namespace fathom
