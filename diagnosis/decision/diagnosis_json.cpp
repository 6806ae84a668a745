#include "diagnosis/decision/diagnosis_json.h"

#include <set>

#include "core/json.h"
#include "diagnosis/statistics/evidence.h"

namespace fathom {

Json json_from(const GapSize& gap) {
  return {
      {"before_rms_mm", gap.before_rms_mm}, {"after_rms_mm", gap.after_rms_mm}, {"noise_floor_mm", gap.noise_floor_mm}};
}

namespace {

Json json_from(const GapLocation& where) {
  // Heights have their unit in the key, whatever else is observed in its name.
  const bool is_length = where.observable.ends_with("_mm");
  return {{"observable", where.observable},
          {"stratum", where.stratum},
          {is_length ? "departure_mm" : "departure", where.departure},
          {is_length ? "mean_mm" : "mean", where.mean},
          {is_length ? "sigma_mm" : "sigma", where.sigma},
          {"share_of_gap", where.share_of_gap},
          {"p", where.p}};
}

std::vector<std::string> ids_of(const std::vector<std::string>& names) {
  std::vector<std::string> ids;
  for (const std::string& name : names) ids.push_back(effect_name(name).id);
  return ids;
}

/// {"name": id}, and of which liquid, where it is of one.
Json named(const std::string& name) {
  const EffectName effect = effect_name(name);
  Json json{{"name", effect.id}};
  if (!effect.liquid.empty()) json["liquid"] = effect.liquid;
  return json;
}

/// An effect with its parameters.
Json sized(const std::string& name, const std::vector<NamedParameter>& parameters) {
  Json json = named(name);
  json["parameters"] = Json::object();
  for (const NamedParameter& parameter : parameters)
    json["parameters"][parameter.name] = {{"value", parameter.value}, {"ci95", {parameter.low95, parameter.high95}}};
  return json;
}

Json json_from(const NamedEffect& effect) {
  Json json = sized(effect.name, effect.parameters);
  json["probability"] = effect.probability;
  json["p_discovery"] = effect.p_discovery;
  json["p_confirmation"] = effect.p_confirmation;
  return json;
}

Json json_from(const Explanation& explanation) {
  Json json{{"effects", ids_of(explanation.effects)}, {"probability", explanation.probability}};
  if (ids_of(explanation.effects) != explanation.effects) json["in_detail"] = explanation.effects;
  for (std::size_t i = 0; i < explanation.sizes.size(); ++i)
    json["sizes"].push_back(sized(explanation.effects[i], explanation.sizes[i]));
  if (explanation.is_too_small) json["too_small_to_show"] = true;
  if (explanation.is_liquid_open) json["liquid_open"] = true;
  std::set<std::set<std::string>> known;
  const auto is_new = [&](const std::vector<std::string>& ids) { return known.emplace(ids.begin(), ids.end()).second; };
  is_new(ids_of(explanation.effects));
  for (const std::vector<std::string>& twin : explanation.alternatives)
    if (const std::vector<std::string> ids = ids_of(twin); is_new(ids)) json["indistinguishable"].push_back(ids);
  if (explanation.supersets.empty()) return json;
  json["alone"] = explanation.alone;
  for (const std::vector<std::string>& superset : explanation.supersets)
    if (const std::vector<std::string> ids = ids_of(superset); is_new(ids)) json["supersets"].push_back(ids);
  return json;
}

Json json_from(const Excess& excess) {
  return {{"level", excess.level}, {"group", excess.group}, {"observable", excess.observable},
          {"part", excess.part},   {"size", excess.size},   {"sigma", excess.sigma},
          {"p", excess.p}};
}

Json json_from(const TakenUp& one) { return {{"input", one.input}, {"rms_mm", one.rms_mm}}; }

Json json_from(const StratumGap& stratum) {
  return {{"stratum", stratum.stratum}, {"train", json_from(stratum.train)}, {"held_out", json_from(stratum.held_out)}};
}

/// "scattering_per_mm" → "per_mm", "rate_mm_per_h" → "mm_per_h", "height_mm" → "mm": what stands behind a parameter's
/// first word.
std::string unit_of(const std::string& parameter) {
  for (const std::string unit : {"_per_mm", "_mm_per_h", "_mm", "_deg", "_px", "_s"})
    if (parameter.ends_with(unit)) return unit.substr(1);
  return "1";
}

Json json_from(const UpperLimit& limit) {
  Json json = named(limit.effect);
  json["parameter"] = limit.parameter;
  json["limit95"] = limit.limit95;
  json["smallest_seen"] = limit.smallest_seen;
  json["unit"] = unit_of(limit.parameter);
  return json;
}

Json json_from(const SizeError& error) {
  Json json = named(error.effect);
  json["parameter"] = error.parameter;
  json["standard_error"] = error.standard_error;
  json["unit"] = unit_of(error.parameter);
  return json;
}

Json json_from(const ConfusablePair& pair) {
  return {{"effects", {pair.first, pair.second}}, {"angle_deg", pair.angle_deg}};
}

Json json_from(const NearNullDirection& direction) {
  return {{"effects", direction.effects}, {"weights", direction.weights}, {"strength", direction.strength}};
}

/// "foam+surface_tilt", as entries of `next` name a set.
std::string joined(const std::vector<std::string>& effects) {
  std::string names;
  for (const std::string& effect : effects) names += (names.empty() ? "" : "+") + effect;
  return names.empty() ? "none" : names;
}

Json json_from(const NextMeasurement& next) {
  Json separates = Json::array();
  for (const std::vector<std::string>& effects : next.separates) separates.push_back(joined(effects));
  return {{"measurement", next.measurement},
          {"separates", separates},
          {"sigma", next.sigma},
          {"minutes", next.cost},
          {"settles", next.settles()}};
}

Json json_from(const ConditionBudget& line) {
  Json json{{"condition", line.condition}, {"observable", line.observable}, {"E", line.comparison_error},
            {"u_D", line.u_data},          {"u_input", line.u_input},       {"u_num", line.u_numerical},
            {"u_val", line.u_validation}};
  if (line.surrogate_difference) json["surrogate_minus_ray_traced"] = *line.surrogate_difference;
  return json;
}

template <class T>
Json array_of(const std::vector<T>& items) {
  Json array = Json::array();
  for (const T& item : items) array.push_back(json_from(item));
  return array;
}

Json json_from(const Gap& gap) {
  return {{"train", json_from(gap.train)},
          {"held_out", json_from(gap.held_out)},
          {"strata", array_of(gap.strata)},
          {"taken_up", array_of(gap.taken_up)}};
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  constexpr std::string_view kNames[] = {"none", "named", "ambiguous", "unknown", "named+unknown", "insufficient"};
  return kNames[static_cast<int>(verdict)];
}

Json json_from(const Diagnosis& diagnosis) {
  Json json;
  json["verdict"] = name_of(diagnosis.verdict);
  json["missing"] = diagnosis.data.missing;
  json["warnings"] = diagnosis.data.warnings;
  json["probability_of_none"] = diagnosis.probability_of_none;
  json["probability_of_unknown"] = diagnosis.probability_of_unknown;
  json["where"] = array_of(diagnosis.departures.where);
  json["beside"] = array_of(diagnosis.departures.beside);
  json["excess"] = array_of(diagnosis.departures.excess);
  json["effects"] = Json::array();
  for (const Mistake& mistake : diagnosis.data.mistakes)
    json["effects"].push_back({{"name", mistake.id}, {"sentence", mistake.sentence}});
  for (const NamedEffect& effect : diagnosis.effects) json["effects"].push_back(json_from(effect));
  json["ambiguity_set"] = array_of(diagnosis.ambiguity_set);
  json["gap"] = json_from(diagnosis.gap);
  json["unknown"] = {{"formula", diagnosis.unknown.formula},
                     {"most_similar", diagnosis.unknown.most_similar},
                     {"similarity", diagnosis.unknown.similarity}};
  if (!diagnosis.unknown.part.empty())
    json["unknown"]["shape"] = {{"liquid", diagnosis.unknown.liquid},
                                {"part", diagnosis.unknown.part},
                                {"higher_mm", diagnosis.unknown.higher_mm}};
  json["upper_limits"] = array_of(diagnosis.limits.upper);
  json["size_errors"] = array_of(diagnosis.limits.size_errors);
  json["confusable"] = array_of(diagnosis.limits.confusable);
  json["near_null"] = array_of(diagnosis.limits.near_null);
  json["next"] = array_of(diagnosis.next);
  json["budget"] = {{"conditions", array_of(diagnosis.budget)}};
  return json;
}

}  // namespace fathom
