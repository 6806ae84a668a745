// What happens to a ray at the boundaries of clear bodies, which may overlap: the body of highest priority is the one
// that the light is in, and light bends only where that changes.
#pragma once

#include <bit>
#include <optional>

#include "sim/render/intersect.h"

namespace fathom {

/// The body that fills the places in all of `inside`: the last; nullptr stands for air.
inline const Body* medium_in(const Geometry& geometry, BodySet inside) {
  return inside ? &geometry.bodies[std::bit_width(inside) - 1] : nullptr;
}
inline double index_of(const Body* medium) { return medium ? medium->medium.n : 1.0; }

/// What light loses in bodies that scatter: all that is scattered, or of the medium without its forward peak, where
/// what is scattered forward goes on.
enum class Loss { all, without_peak };
/// [1/m]
inline double extinction_of(const Body* medium, Loss loss = Loss::all) {
  if (!medium) return 0.0;
  return (loss == Loss::all ? medium->medium : medium->without_peak).extinction();
}

/// A surface's glaze as it is in front of that medium.
inline const Glaze& glaze_under(const Geometry& geometry, const Glazed& glazed, const Body* medium) {
  return glazed.under[medium ? 1 + static_cast<std::size_t>(medium - geometry.bodies.data()) : 0];
}

/// The bodies around a ray after it has gone through the interface that it hits.
BodySet beyond(const Hit& hit, BodySet inside);

/// A place where the medium changes along a ray.
struct Crossing {
  Hit hit;
  BodySet before, beyond;  ///< bodies around the ray on both sides
  const Body *from, *to;   ///< media on both sides
};
/// The next one on a ray, boundaries within other bodies passed over and opaque surfaces ignored. The hit's distance
/// counts from the ray's origin.
std::optional<Crossing> next_crossing(const Intersector& world, const Ray& ray, BodySet inside);

}  // namespace fathom
