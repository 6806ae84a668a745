// A laboratory: what it believes of its rig and cup, how well, and how far the truth is off in one set.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "blind/pack_plan.h"
#include "blind/world.h"
#include "core/json.h"

namespace fathom::blind {

/// The shot as the laboratory believes it to be.
World believed(const Placement& placement);

/// A length or angle that the laboratory knows to so much; `add` makes the truth of it by so many of its units.
struct Uncertain {
  std::string_view name;  ///< key of rig.json
  double sigma;           ///< 1 σ, as rig.json says
  void (*add)(World&, double amount);
};
std::span<const Uncertain> uncertain_rig();

/// rig.json of all sets: what is believed, and how well.
Json rig_json();

/// How much otherwise a session sets the rig up; no file says so.
struct SessionError {
  double sigma;
  void (*add)(World&, double amount);
};
std::span<const SessionError> session_errors();

/// What every set has a little of and no registry describes (world.h), in pixels; no file says so either.
std::span<const Uncertain> dust();

inline constexpr double kFillSigma = 0.5e-3, kPlacementSigma = 0.5e-3;

/// Moves the truth away from what is believed, by draws keyed by the set's seed: the rig's errors, a little more for
/// each session's setting up, each pour's fill, each placement's place, the unit's bias, and dust. `scale` multiplies
/// all but the unit's bias and the dust.
World true_world(const Placement& placement, std::uint64_t seed, double scale);

}  // namespace fathom::blind
