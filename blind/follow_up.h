// A further session at a set's rig, as a diagnosis asks for it: the spec of a campaign.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "blind/pack_plan.h"
#include "core/json.h"

namespace fathom::blind {

struct FollowUp {
  std::vector<Filling> fillings;
  std::vector<double> distance_mm, lateral_mm;
  int pours, placements, trials;  ///< of each filling, of each pour at each place, of each placement
  int bare_desk_views;            ///< shots before the first cup
  double wait_s;                  ///< before the cup is put down again
  Json new_liquids;               ///< as rig.json describes them
};

/// Throws Error for another rig than the laboratory's, for what it cannot pour and for places beyond its desk.
FollowUp read_follow_up(const std::filesystem::path& spec);

/// In the spec's order. Session, pours and placements have the numbers after those of `earlier`: what is drawn by them
/// is drawn anew. The first shot of a pour is that of a fresh one, as frames.csv says; what is to be waited follows it.
std::vector<Placement> plan(const FollowUp& wanted, std::span<const Placement> earlier);

}  // namespace fathom::blind
