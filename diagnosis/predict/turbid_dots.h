// What a turbid liquid makes of the dots that are thrown on it: how deep a matcher that follows them sees, and how much
// of their contrast is left. By random walks near the normal in a liquid of n = 1.336 that scatters evenly (others by
// similarity, g → μs′) and absorbs next to nothing.
#pragma once

namespace fathom {

/// Length of the way into a half-space, and out again, in transport mean free paths, at whose end light seems to be
/// scattered back. A camera that looks in one direction sees light whose last flight was in that direction, as its
/// first one was in the projector's: in the mean both are about a path long. But dots that spread keep their middle:
/// where two images of a sharp dot correlate as a Gaussian of standard deviation `core_paths` [transport mean free
/// paths], the correlation's maximum follows the light that left near where it entered, down to what scatters once:
/// half a path. From 0.93 for a wide core to 0.50 for a narrow one; good to 1 %.
double seen_depth(double core_paths);

/// The contrast of sparse dots (deviation over mean of their image) over that of the same dots on a surface. Light that
/// entered at one point leaves around it by K(r), of integral 1; of dots that correlate as a Gaussian of standard
/// deviation c = `core_paths` its Fourier transform leaves √( ∫ K̂(q)² exp(−q²c²/2) q dq / ∫ exp(−q²c²/2) q dq ).
/// From 1 for a wide core down to the share of light that leaves where it entered. Good to 2 %.
double dot_contrast(double core_paths);

}  // namespace fathom
