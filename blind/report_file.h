// What an analyser answered: the parts of its report.json that are scored.
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace fathom::blind {

using Names = std::set<std::string>;

struct Estimated {
  double value, low, high;  ///< with its 95 % interval
};

struct Answer {
  std::string verdict;  ///< none, named, ambiguous, unknown, named+unknown, insufficient; "missing" without a report
  Names named;          ///< effects, without "@liquid"
  std::map<std::string, std::map<std::string, Estimated>> parameters;  ///< of each
  /// Standard errors of its sizes, parameter by parameter, of effects of all liquids: what the measurement tells by its
  /// own reckoning.
  std::map<std::string, std::map<std::string, double>> size_errors;
  struct Explanation {
    std::vector<Names> sets;       ///< its effects, then the sets that cannot be told from these
    std::vector<Names> supersets;  ///< sets that add effects to one of `sets`, and are not excluded
    double probability;            ///< of all of them

    bool leaves_open(const std::function<bool(const Names&)>& is) const {
      return std::any_of(sets.begin(), sets.end(), is) || std::any_of(supersets.begin(), supersets.end(), is);
    }
    /// Whether they are a set and, together, some of what its supersets add to it by one.
    bool leaves_open_together(const Names& effects) const;
  };
  std::vector<Explanation> ambiguity_set;  ///< most probable first
  Names liquids_in_gap;                    ///< liquids of the strata in which it finds a gap, p < 0.01 …
  bool gap_in_all_liquids = false;  ///< … and whether it finds one in a stratum that is of no liquid in particular
  std::string warnings;             ///< joined
  double before_rms = 0.0, after_rms = 0.0, noise_floor = 0.0;  ///< [mm] held out
  struct Proposal {
    std::string measurement;
    std::string spec;     ///< a campaign's, beside the report; "" where it would settle nothing
    Names first, second;  ///< explanations that it tells apart
    double sigma;         ///< … by so much
  };
  std::vector<Proposal> next;  ///< what it proposes to measure, pair by pair, the likeliest first

  bool names_something() const { return !named.empty(); }
  bool detects_something() const { return verdict != "none" && verdict != "missing" && verdict != "insufficient"; }
  bool finds_unknown() const { return verdict == "unknown" || verdict == "named+unknown"; }
  double probability_of(const Names& effects) const;  ///< as an explanation
  bool holds(const Names& effects) const { return probability_of(effects) > 0.0; }
  /// Of what it puts first.
  double confidence() const { return ambiguity_set.empty() ? 0.0 : ambiguity_set.front().probability; }
};

/// `folder/report.json`, and `next.json` where there is one. A folder without one is an answer with the verdict
/// "missing".
Answer read_answer(const std::filesystem::path& folder);

}  // namespace fathom::blind
