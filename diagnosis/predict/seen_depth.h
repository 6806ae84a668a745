// How deep in a turbid liquid its light seems to be sent back, to a matcher that follows dots.
#pragma once

namespace fathom {

/// Length of the way into a half-space, and out again, in transport mean free paths, at whose end light seems to be
/// scattered back. A camera that looks in one direction sees light whose last flight was in that direction, as its
/// first one was in the projector's: in the mean both are about a path long. But dots that spread keep their middle:
/// where two images of a sharp dot correlate as a Gaussian of standard deviation `core_paths` [transport mean free
/// paths], the correlation's maximum follows the light that left near where it entered, down to what scatters once:
/// half a path. From 0.93 for a wide core to 0.50 for a narrow one.
/// By random walks near the normal in a liquid of n = 1.336 that scatters evenly (others by similarity, g → μs′) and
/// absorbs next to nothing; good to 1 %.
double seen_depth(double core_paths);

}  // namespace fathom
