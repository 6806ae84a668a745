// Observations that have something in common: a pour, a placement, a level of a factor.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// The group of every observation, 0 … count-1 in the order of first appearance; -1: in none.
struct Groups {
  std::vector<int> of;
  int count = 0;

  std::vector<std::vector<Eigen::Index>> members() const;
};

/// Observations with the same key; those with an empty key are in no group.
Groups group_by(const std::vector<Observation>& observations,
                const std::function<std::string(const Observation&)>& key);

/// Whether a cup stands on the desk, and whether something was poured into it.
bool has_cup(const Factors& factors);
bool has_liquid(const Factors& factors);

/// One pour is one filling in one session, one placement one putting-down of it. Bare desks and empty cups are never
/// poured. Nothing is put down on a bare desk: all of its views in a session show the same dots at the same places.
std::string session_key(const Observation& observation);
/// Laboratories number pours anew for each filling, too. Empty where nothing is poured.
std::string pour_of(const Factors& factors);
std::string pour_key(const Observation& observation);
std::string placement_key(const Observation& observation);
/// What a repetition with a new pour and placement would have in common: liquid, fill, distance, lateral.
std::string condition_key(const Observation& observation);
/// Condition, observable and region: within a cell observations differ by error alone.
std::string cell_key(const Observation& observation);

/// The factors by which a gap may be localised, and an observation's level of one: "400" of "distance_mm".
const std::vector<std::string>& factor_names();
std::string level(const Observation& observation, const std::string& factor);

/// Fill, distance and lateral of every observation (n × 3), each from 0 to 1 over its range among cups; 0 where all are
/// the same.
Eigen::MatrixXd places_in_ranges(const std::vector<Observation>& observations);

/// Observables named so are heights: "height_mm", "desk_height_mm".
bool is_height(const Observation& observation);

}  // namespace fathom
