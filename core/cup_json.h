// What files say of a cup: four lengths, or its profiles.
#pragma once

#include <optional>

#include "core/cup_profile.h"

namespace fathom {

/// Upright walls on a flat bottom, by `height_mm`, `bottom_mm`, `inner_radius_mm` and `outer_radius_mm`. Where a
/// `usual` cup is given, lengths that are missing are its own (its radii 45 mm above the desk). Throws Error where a
/// length is missing, out of kCupLengthMm, or leaves no wall or no hollow.
CupProfile straight_cup_from_json(const JsonReader& json, const std::optional<CupProfile>& usual = {});

/// The same four keys, which say all of a straight cup; the radii are those 45 mm above the desk.
Json lengths_json(const CupProfile& cup);

/// {"inner_profile_mm", "outer_profile_mm"}
Json profiles_json(const CupProfile& cup);

/// [m] above the desk: where radii are those of a cup whose walls lean, and a detector fits its circle.
inline constexpr double kRadiiAt_m = 0.045;

}  // namespace fathom
