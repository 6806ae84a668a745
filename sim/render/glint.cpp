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
    Flight flight{ray_differential_from(source_.position, direction), source_.inside, 1.0};
    for (int mirror = 0; mirror < kLongestChain && flight.transmittance > kFaintest; ++mirror) {
      const auto next =
          next_crossing(world_, {flight.differential.origin, flight.differential.direction}, flight.inside);
      if (!next) return;
      Flight mirrored = flight;
      pass(world_, *next, Event::reflect, mirrored);
      follow(mirrored, mirror, kReach * width, direction);
      pass(world_, *next, Event::refract, flight);
    }
  }

  std::vector<Connection> found;

 private:
  static constexpr double kReach = 3.0;
  static constexpr int kLongestChain = 8;
  static constexpr double kFaintest = 1e-4;  ///< transmittance

  /// Follows what interface number `mirror` has mirrored, and shoots wherever it comes within an angle of the eye.
  void follow(Flight flight, int mirror, double angle, const Eigen::Vector3d& direction) {
    for (int crossings = mirror + 1; flight.transmittance > kFaintest; ++crossings) {
      if (flight.inside == 0 && lands_within(angle, flight.differential))
        add_new(found, shoot(world_, source_, eye_, nullptr, direction, crossings, mirror));
      const auto next =
          next_crossing(world_, {flight.differential.origin, flight.differential.direction}, flight.inside);
      if (!next || crossings == kLongestChain) return;
      pass(world_, *next, Event::refract, flight);
    }
  }

  bool lands_within(double angle, const RayDifferential& differential) const {
    const Landing landing = land(differential, eye_);
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
