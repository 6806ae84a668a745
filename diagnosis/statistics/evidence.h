// What the statistics see of a campaign: what was measured, what the model predicts, and how it could be wrong.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fathom {

/// How an observation came about. What does not apply is 0 or empty.
struct Factors {
  int session = 0, pour = 0, placement = 0;
  double time_s = 0.0;   ///< since the session began, mean of the repeats
  double stood_s = 0.0;  ///< since the first frame of its pour, mean of the repeats
  std::string liquid;    ///< "empty", "none" (bare desk), or a liquid of the rig
  double fill_mm = 0.0, distance_mm = 0.0, lateral_mm = 0.0;
  std::string region;                          ///< of the cup or of the desk around it
  std::optional<Eigen::Vector2d> within_mm{};  ///< where a part of the cup lies from its middle: right, far
};

/// A point of the cup, from its middle: right, far; and how much of its height is in an observation.
struct SeenPart {
  Eigen::Vector2d at_mm;
  double weight;
};

/// One number that a cloud gives, over the repeats (trials) of one placement.
struct Observation {
  std::string observable;  ///< its name, with its unit: "height_mm", "log_brightness"
  Factors factors;
  double value = 0.0;      ///< mean of the repeats
  double repeat_sd = 0.0;  ///< of one repeat; 0 with one repeat
  int repeats = 1;
  double pixels = 0.0;       ///< of one repeat, that the value is the mean of; 0: of no certain number
  double rounding = 0.0;     ///< 1 σ of the error of each repeat's being rounded; 0: too little to count
  double stray_share = 0.0;  ///< of a height: of those that it could be the mean of, which are too far off to count
  std::vector<SeenPart> parts{};  ///< of the cup, of whose heights it is the sum; none: of something else, or not known
  bool is_of_session = false;     ///< mean of a session's placements: liquid, fill and place are those of one of them
  bool has_all_errors = false;    ///< repeats are set-ups made anew, so that what they scatter by is all its error
  bool only_names =
      false;  ///< helps to name what makes a gap; that there is one, heights and shapes decide (decision/tiers.h)
};

/// Something uncertain that is no effect: a calibrated length, the fill of one pour, the place of one placement.
struct Nuisance {
  std::string name;
  double sigma = 0.0;           ///< of its prior, about 0
  Eigen::VectorXd sensitivity;  ///< change of every observation per unit
  std::string kind{};           ///< what a reader knows many of them by, such as "fills"; empty: the name
};

/// An error of the model that observations of one group have in common; how large it is, the data may say better.
struct SharedError {
  std::string observable;
  std::vector<int> group_of;     ///< of each observation, from 0; -1: of no group, or another observable
  double sigma = 0.0;            ///< 1 σ, as large as it is thought to be
  double of_pixels = 0.0;        ///< σ is that of a mean of so many pixels, and larger of fewer; 0: of all alike
  bool is_by_condition = false;  ///< each condition has an error of its own
};

struct Parameter {
  std::string name;          ///< with its unit: "scattering_per_mm"
  double nominal = 0.0;      ///< the value at which the effect is absent
  double prior_scale = 1.0;  ///< a typical departure from nominal
  double lower = 0.0, upper = 0.0;
  double step = 0.0;  ///< the model knows only whole multiples of it; 0: all values
};

/// What comes with an effect and nobody can predict (statistics/leeway.h).
struct OwnErrors {
  Eigen::MatrixXd columns{};  ///< observations × errors, 1 σ each
  /// The variance is max(0, |first parameter| − grow_from) times that of `columns`, in typical departures; empty: 1
  /// times.
  std::optional<double> grow_from{};
};

/// Of an effect: "id", or "id@liquid" for the effect in one liquid only.
struct EffectName {
  std::string id, liquid;  ///< no liquid: in all
};

inline EffectName effect_name(std::string_view name) {
  const std::size_t at = name.find('@');
  if (at == std::string_view::npos) return {std::string(name), ""};
  return {std::string(name.substr(0, at)), std::string(name.substr(at + 1))};
}

inline std::string name_of(const EffectName& effect) {
  return effect.liquid.empty() ? effect.id : effect.id + "@" + effect.liquid;
}

/// An effect that the model leaves out.
struct Candidate {
  std::string effect;  ///< as name_of(EffectName) writes it
  std::vector<Parameter> parameters;
  Eigen::MatrixXd sensitivity;  ///< observations × parameters: change per unit, by differences over prior_scale
  double plausibility = 1.0;    ///< before anything is measured, beside that of other candidates
  OwnErrors leeway{};
};

/// A mistake in the laboratory's notes that its measurements show, and that was put right before anything else.
struct Mistake {
  std::string id;        ///< "label_swap"
  std::string sentence;  ///< what it was
};

/// By how much the laboratory says that its repetitions may differ, 1 σ. What differs more is a finding
/// (decision/excess.h).
struct StatedScatter {
  static constexpr double kAny = std::numeric_limits<double>::infinity();
  double session_mm = kAny, session_deg = kAny;  ///< sessions, beyond what the nuisances say
  double fill_mm = kAny, placement_mm = kAny;    ///< fills of pours, places of cups; heights differ by no more
};

/// Of a session, the part of its desk that differs most from what the other sessions show there; of all sessions
/// together, the place where the unit's bias is least like the rest of it.
struct OddDesk {
  std::optional<int> session;
  std::string part;  ///< "in columns 480 to 560 and rows 64 to 144 of the image"
  double higher_mm = 0.0, sigma_mm = 0.0;
  double p = 1.0;  ///< of all parts that were looked at
};

struct Evidence {
  std::vector<Observation> observations;
  Eigen::VectorXd predicted;  ///< by the nominal model, one for each observation
  std::vector<Nuisance> nuisances;
  std::vector<Candidate> candidates;
  Eigen::VectorXd numerical_sd{};            ///< 1 σ of the predictions' own numerical error; empty: none is stated
  std::vector<SharedError> shared_errors{};  ///< of the predictions, too
  std::vector<Mistake> mistakes{};           ///< put right in the observations
  StatedScatter stated{};
  std::vector<OddDesk> odd_desks{};
  bool is_calibrated = false;  ///< the sensor's own errors were learned from other views, as far as they can be
};

/// An effect switched on, with the values of its parameters in their order.
struct EffectValue {
  std::string effect;  ///< as name_of(EffectName) writes it
  std::vector<double> values;
};

/// The observations as the model with these effects predicts them.
using Predict = std::function<Eigen::VectorXd(const std::vector<EffectValue>&)>;

/// The evidence of some observations alone.
Evidence evidence_of_rows(const Evidence& evidence, const std::vector<Eigen::Index>& rows);

}  // namespace fathom
