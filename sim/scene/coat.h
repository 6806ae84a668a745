// A clear coat over an opaque surface.
#pragma once

namespace fathom {

/// Of what optics/glaze.h makes a glaze; the albedo that stands beside it is that of the body within the coat.
struct Coat {
  double roughness;  ///< α of optics/ggx.h, at least kLeastRoughness
  double index = 1.5;

  bool operator==(const Coat&) const = default;
};

/// The highlight of a smoother coat on a wall of 40 mm, whose normal turns by this angle [rad] over 0.8 mm, would be
/// narrower than an infrared pixel from half a metre away.
inline constexpr double kLeastRoughness = 0.02;

}  // namespace fathom
