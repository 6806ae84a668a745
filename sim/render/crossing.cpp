#include "sim/render/crossing.h"

namespace fathom {

BodySet beyond(const Hit& hit, BodySet inside) {
  const Interface& interface = std::get<Interface>(hit.surface->optics);
  if (interface.liquid) {
    const BodySet liquid = BodySet{1} << *interface.liquid;
    inside = interface.wetted && !hit.entering ? inside | liquid : inside & ~liquid;
  }
  const BodySet body = BodySet{1} << interface.body;
  return hit.entering ? inside | body : inside & ~body;
}

std::optional<Crossing> next_crossing(const Intersector& world, const Ray& ray, BodySet inside) {
  Ray rest = ray;
  double passed = 0.0;
  while (std::optional<Hit> hit = world.first_interface(rest)) {
    const BodySet after = beyond(*hit, inside);
    const Body *from = medium_in(world.geometry(), inside), *to = medium_in(world.geometry(), after);
    if (from != to) {
      hit->distance += passed;
      return Crossing{*hit, inside, after, from, to};
    }
    inside = after;
    passed += hit->distance;
    rest.origin = hit->point;
  }
  return std::nullopt;
}

}  // namespace fathom
