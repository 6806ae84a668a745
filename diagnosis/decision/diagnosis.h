// What a diagnosis says: whether model and measurement disagree, where, by which effects, and what stays open.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

enum class Verdict { none, named, ambiguous, unknown, named_and_unknown, insufficient };
/// As in report.json: "none", "named", …, "named+unknown".
std::string_view name_of(Verdict verdict);

/// What was found about the measurements themselves.
struct DataQuality {
  std::vector<std::string> missing;   ///< if insufficient: what they lack
  std::vector<std::string> warnings;  ///< book-keeping that looks wrong; tests that could not be made
  std::vector<Mistake> mistakes;      ///< of the laboratory, put right before all else
};

/// A part of the observations that departs from the prediction.
struct GapLocation {
  std::string observable, stratum;  ///< "height_mm", "liquid=milk_tea, distance_mm=400"
  double mean = 0.0, sigma = 0.0;   ///< in the observable's unit, beside the other parts'
  double share_of_gap = 0.0;        ///< of the squared gap in units of its error; of all parts at most 1 together
  double p = 1.0;                   ///< that errors alone make a part depart so, of all that were looked at
  double departure = 0.0;           ///< plain mean of what was measured there minus predicted
};

/// A group that differs from the others by more than the laboratory states.
struct Excess {
  std::string level;       ///< "session", "unit"; "pour", "placement", "trial": from each to the next
  std::string group;       ///< the session's number; of the others nothing
  std::string observable;  ///< "height_mm"
  std::string part;        ///< of what is observed, "in columns … of the image"; empty: all of it
  double size = 0.0;  ///< beside the others' mean, or the unit's bias elsewhere; of pours, placements and trials 1 σ of
                      ///< the scatter itself
  double sigma = 0.0;  ///< 1 σ of that
  double p = 1.0;      ///< of all groups and observables that were looked at
};

/// Where measurement and prediction differ by more than their errors.
struct Departures {
  std::vector<GapLocation> where;
  std::vector<GapLocation> beside;          ///< of what only names; they are no gap by themselves
  std::vector<std::string> beside_effects;  ///< that would explain these, if any would
  std::vector<Excess> excess;               ///< largest first, in errors
};

struct NamedParameter {
  std::string name;
  double value = 0.0, low95 = 0.0, high95 = 0.0;
};

struct NamedEffect {
  std::string name;
  std::vector<NamedParameter> parameters;
  double probability = 0.0;     ///< that it is there, in whatever liquid
  double p_discovery = 1.0;     ///< that errors alone make as much beside the others, for any of all candidates
  double p_confirmation = 1.0;  ///< that they do in groups of conditions that had no part in finding its size
};

/// Effects that explain the data about as well as the best ones do.
struct Explanation {
  std::vector<std::string> effects;                    ///< none: no effect; "unknown": what no candidate explains
  std::vector<std::vector<std::string>> alternatives;  ///< cannot be told from them, or are them in another liquid
  std::vector<std::vector<std::string>> supersets;     ///< hold more that the data neither need nor exclude
  double probability = 0.0;                            ///< of all of these together
  double alone = 0.0;                                  ///< without the supersets
  bool is_too_small = false;                           ///< for these measurements to show
  bool is_liquid_open = false;                         ///< all are the same effects, but in which liquids is not sure
  std::vector<std::vector<NamedParameter>> sizes{};    ///< of each effect, fitted together; none where not fitted
};

/// Root mean square of the heights' residuals.
struct GapSize {
  double before_rms_mm = 0.0, after_rms_mm = 0.0, noise_floor_mm = 0.0;
};

/// The heights of one level of one factor.
struct StratumGap {
  std::string stratum;  ///< "liquid=milk"
  GapSize train, held_out;
};

/// What of the heights' residuals an uncertain input takes up, at its likeliest value.
struct TakenUp {
  std::string input;
  double rms_mm = 0.0;
};

/// How large the gap is, and what the effects leave of it.
struct Gap {
  GapSize train, held_out;
  std::vector<StratumGap> strata;
  std::vector<TakenUp> taken_up;  ///< largest first, those above a tenth of the residuals
};

struct UpperLimit {
  std::string effect, parameter;
  double limit95 = 0.0;        ///< departure from nominal that would have been seen
  double smallest_seen = 0.0;  ///< the one that would be named with 50 % probability
};

/// How well the measurements know an effect's size.
struct SizeError {
  std::string effect, parameter;
  double standard_error = 0.0;  ///< of the parameter, in its unit, if the model lacks nothing else
};

struct ConfusablePair {
  std::string first, second;
  double angle_deg = 0.0;  ///< between their sensitivities, after nuisances
};

/// A combination of effects that the observations hardly see.
struct NearNullDirection {
  std::vector<std::string> effects;
  std::vector<double> weights;  ///< of typical departures, together of length 1
  double strength = 0.0;        ///< norm of its whitened sensitivity
};

/// What the measurements cannot show, or cannot tell apart.
struct Limits {
  std::vector<UpperLimit> upper;
  std::vector<SizeError> size_errors;
  std::vector<ConfusablePair> confusable;
  std::vector<NearNullDirection> near_null;
};

struct NextMeasurement {
  std::string measurement;
  std::vector<std::vector<std::string>> separates;  ///< two sets of effects; one of none is the model as it is
  double sigma = 0.0;                               ///< by which it would tell them apart
  double cost = 1.0;                                ///< minutes
  bool settles() const { return sigma >= 3.0; }
};

/// ASME V&V 20-2009 for one condition and observable.
struct ConditionBudget {
  std::string condition, observable;
  double comparison_error = 0.0;  ///< E, measured − predicted
  double u_data = 0.0, u_input = 0.0, u_numerical = 0.0, u_validation = 0.0;
  std::optional<double> surrogate_difference =
      {};  ///< few rays' prediction minus the ray tracer's, where that is known
};

/// What no model can explain: the shape of the rest.
struct UnknownShape {
  std::string formula;       ///< sparse, in distance, fill and lateral
  std::string most_similar;  ///< candidate
  double similarity = 0.0;   ///< cosine of the whitened sensitivities
  std::vector<double> map;   ///< smooth part of every observation's residual, in the observable's unit
  /// Of a shape of what is seen in cups: the part that departs most, and by how much. Empty where it is none.
  std::string liquid, part;
  double higher_mm = 0.0;
};

/// Of every observation, in its unit.
struct Residuals {
  std::vector<double> before;  ///< measured minus predicted
  std::vector<double> after;   ///< the same with the effects, nuisances at their best values
  std::vector<double> error;   ///< 1 σ of that
};

struct Diagnosis {
  Verdict verdict = Verdict::insufficient;
  DataQuality data;
  double probability_of_none = 1.0;     ///< that nothing is missing
  double probability_of_unknown = 0.0;  ///< that something is there which no candidate explains, beside effects or not
  Departures departures;
  std::vector<NamedEffect> effects;
  std::vector<Explanation> ambiguity_set;  ///< most probable first, together 1
  /// Of all effects' parameters, in their order, in their units: rows of the matrix.
  std::vector<std::vector<double>> parameter_covariance;
  Gap gap;
  Limits limits;
  std::vector<NextMeasurement> next;
  std::vector<ConditionBudget> budget;
  UnknownShape unknown;  ///< where the verdict says that there is something
  Residuals residuals;
};

}  // namespace fathom
