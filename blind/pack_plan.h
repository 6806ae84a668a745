// What a laboratory sets out to measure: designs, and the order of their pours and placements.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fathom::blind {

struct Filling {
  std::string liquid;  ///< "empty" or one that the laboratory has
  double fill_mm;
};

struct Design {
  std::string_view name;
  std::vector<Filling> fillings;
  std::vector<double> distance_mm, lateral_mm;
  int pours, trials;
  int bare_views;  ///< frames of the bare desk
  bool infrared;   ///< false: the laboratory's clouds hold no intensity
  bool clouds;     ///< false: a table of mean heights
};

std::span<const Design> designs();
const Design& design(std::string_view name);

/// The cup put down once; its trials follow each other.
struct Placement {
  int number = 0, session = 0, pour = 0;
  std::string liquid;                                ///< "none": the bare desk
  double fill = 0.0, distance = 0.0, lateral = 0.0;  ///< [m] nominal
  double time_s = 0.0;                               ///< of the first trial, since the session began
  double since_poured_s = 0.0;
  int trials = 1;

  bool has_cup() const { return liquid != "none"; }
};

inline constexpr double kSecondsPerPour = 90.0, kSecondsPerPlacement = 20.0, kSecondsPerTrial = 2.0;

/// A session holds one pour of every filling, in an order drawn anew, at all places in an order drawn anew.
std::vector<Placement> plan(const Design& design, std::uint64_t seed);

}  // namespace fathom::blind
