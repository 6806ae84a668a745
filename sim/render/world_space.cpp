#include "sim/render/world_space.h"

#include <algorithm>
#include <limits>

namespace fathom {

const Turbid& WorldSpace::medium(const Walker& walker) const {
  static constexpr Turbid kAir;
  const Body* body = medium_in(world_.geometry(), walker.region);
  if (!body) return kAir;
  return walker.scatterings == 0 ? body->medium : body->without_peak;
}

WorldSpace::Boundary WorldSpace::next_boundary(const Walker& walker, double reach) const {
  const Ray ray{walker.position, walker.direction};
  const Body* body = medium_in(world_.geometry(), walker.region);
  if (!body || !body->plain) {
    std::optional<Hit> hit = world_.first_hit(ray);
    const double distance = hit ? hit->distance : 0.0;
    return {distance, std::move(hit), false};
  }
  // A level surface is met exactly, however near it the flight begins.
  const double rise = *body->level - walker.position.z();
  const double to_level =
      walker.direction.z() > 0.0 ? std::max(rise, 0.0) / walker.direction.z() : std::numeric_limits<double>::infinity();
  if (body->vessel) {
    const double clearance = body->vessel->clearance(walker.position);
    // So far from any wall is outside: who slipped through where two triangles meet would walk there for ever.
    if (clearance > 2.0 * body->vessel->profile.back().x()) return {0.0, std::nullopt, false};
    if (std::min(reach, to_level) < clearance) return {to_level, std::nullopt, true};
  }
  std::optional<Hit> hit = world_.first_opaque(ray);
  if (hit && hit->distance < to_level) return {hit->distance, hit, false};
  return std::isfinite(to_level) ? Boundary{to_level, std::nullopt, true} : Boundary{0.0, std::nullopt, false};
}

}  // namespace fathom
