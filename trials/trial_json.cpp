// A trial's file: what a killed evaluation goes on with.
#include "trials/trial.h"

namespace fathom {
namespace {

Json optional_number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

std::optional<double> number_if_any(const JsonReader& json, const char* key) {
  return json.value()[key].is_null() ? std::nullopt : std::optional(json.number(key));
}

Json json_of(const TrialCup& cup) {
  return {{"shape", cup.shape},
          {"liquid", cup.liquid},
          {"fill_mm", cup.fill_mm},
          {"kind", cup.kind},
          {"position_mm", {cup.position_mm.x(), cup.position_mm.y()}},
          {"distance_mm", cup.distance_mm},
          {"visible", cup.visible},
          {"found", cup.found},
          {"liquid_found", cup.liquid_found},
          {"surface_mm", optional_number(cup.surface_mm)},
          {"p_liquid", optional_number(cup.p_liquid)},
          {"kind_found", cup.kind_found},
          {"fill_found_mm", optional_number(cup.fill_found_mm)},
          {"fill_sigma_mm", optional_number(cup.fill_sigma_mm)},
          {"miss", cup.miss ? Json(name_of(*cup.miss)) : Json()},
          {"why", cup.why}};
}

TrialCup trial_cup_from_json(const JsonReader& json) {
  TrialCup cup;
  cup.shape = json.text("shape");
  cup.liquid = json.text("liquid");
  cup.fill_mm = json.number("fill_mm");
  cup.kind = json.text("kind");
  cup.position_mm = json.at("position_mm").vector2();
  cup.distance_mm = json.number("distance_mm");
  cup.visible = json.number("visible");
  cup.found = json.value()["found"].get<bool>();
  cup.liquid_found = json.text("liquid_found");
  cup.surface_mm = number_if_any(json, "surface_mm");
  cup.p_liquid = number_if_any(json, "p_liquid");
  cup.kind_found = json.text("kind_found");
  cup.fill_found_mm = number_if_any(json, "fill_found_mm");
  cup.fill_sigma_mm = number_if_any(json, "fill_sigma_mm");
  for (const Miss miss : kMisses)
    if (json.value()["miss"] == name_of(miss)) cup.miss = miss;
  cup.why = json.text("why");
  return cup;
}

}  // namespace

Json json_of(const TrialResult& result) {
  Json cups = Json::array();
  for (const TrialCup& cup : result.cups) cups.push_back(json_of(cup));
  return {{"cups", cups},
          {"false_cups", result.false_cups},
          {"others", result.others},
          {"sensor", result.sensor},
          {"shoot_s", result.shoot_s},
          {"detect_s", result.detect_s},
          {"stages_s", result.stages_s}};
}

TrialResult trial_from_json(const JsonReader& json) {
  json.allow_only({"cups", "false_cups", "others", "sensor", "shoot_s", "detect_s", "stages_s"});
  TrialResult result;
  for (const JsonReader& cup : json.at("cups").items()) result.cups.push_back(trial_cup_from_json(cup));
  for (const JsonReader& name : json.at("false_cups").items()) result.false_cups.push_back(name.text());
  result.others = json.at("others").integer(0, 1 << 20);
  result.sensor = json.text("sensor");
  result.shoot_s = json.number("shoot_s");
  result.detect_s = json.number("detect_s");
  result.stages_s = json.value()["stages_s"].get<std::map<std::string, double>>();
  return result;
}

}  // namespace fathom
