// The inside and the outside of an upright cup of revolution, and what files say of them: four lengths, or profiles.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/json_fwd.h"
#include "core/range.h"

namespace fathom {

/// Sizes and places [mm] that files may give a cup. Within them a nanometre, to which levels are bisected, is far above
/// rounding, and the meshes of wavy liquids fit in memory.
inline constexpr Range kCupLengthMm{0.0, 2000.0, true};
inline constexpr Range kCupPlaceMm{-1e5, 1e5};
/// Of a body of revolution; each becomes hundreds of triangles.
inline constexpr std::size_t kMostProfilePoints = 2000;

/// [m] above the desk: where radii are those of a cup whose walls lean, and a detector fits its circle.
inline constexpr double kRadiiAt_m = 0.045;

/// Profiles run from the axis (radius 0) to the rim as (radius, height above the desk) [m].
struct CupProfile {
  std::vector<Eigen::Vector2d> inner;  ///< from the inner bottom's centre to the rim
  std::vector<Eigen::Vector2d> outer;  ///< from the underside's centre to the rim

  double height() const { return outer.back().y(); }
  double bottom() const { return inner.front().y(); }
  /// Radii at a height above the desk [m], by linear interpolation of the profiles.
  double inner_radius(double height_above_desk) const;
  double outer_radius(double height_above_desk) const;
  /// Points of `inner` that are the bottom's: from the axis, as long as it rises by less than 45°.
  std::size_t bottom_points() const;
  /// Least radius of the inner wall, from the bottom's edge to the rim: within it no wall is.
  double narrowest() const;
  /// Greatest radius of the outside.
  double widest() const;
  /// Whether both walls are upright, on a flat bottom: four lengths then say all.
  bool is_straight() const;

  bool operator==(const CupProfile&) const = default;
};

/// Lengths [m].
CupProfile straight_cup(double height, double bottom, double inner_radius, double outer_radius);

/// By `inner_profile_mm` and `outer_profile_mm`, or by `height_mm`, `bottom_mm`, `inner_radius_mm` and
/// `outer_radius_mm`. Other keys are the caller's.
CupProfile cup_profile_from_json(const JsonReader& json);

bool has_profile(const JsonReader& json);

/// Upright walls on a flat bottom, by `height_mm`, `bottom_mm`, `inner_radius_mm` and `outer_radius_mm`. Where a
/// `usual` cup is given, lengths that are missing are its own (its radii 45 mm above the desk). Throws Error where a
/// length is missing, out of kCupLengthMm, or leaves no wall or no hollow.
CupProfile straight_cup_from_json(const JsonReader& json, const std::optional<CupProfile>& usual = {});

/// The same four keys, which say all of a straight cup; the radii are those 45 mm above the desk.
Json lengths_json(const CupProfile& cup);

/// {"inner_profile_mm", "outer_profile_mm"}
Json profiles_json(const CupProfile& cup);

}  // namespace fathom
