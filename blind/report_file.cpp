#include "blind/report_file.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "core/json.h"

namespace fathom::blind {
namespace {

/// "refractive_index@water" is the effect limited to one liquid.
std::string effect_of(const std::string& name) { return name.substr(0, name.find('@')); }

Names names_of(const Json& list) {
  Names names;
  for (const Json& name : list) names.insert(effect_of(name.get<std::string>()));
  return names;
}

/// "foam+fill_offset@water", as proposals name a set; "none" is that of nothing.
Names names_of_set(const std::string& text) {
  Names names;
  std::istringstream parts(text == "none" ? "" : text);
  for (std::string part; std::getline(parts, part, '+');) names.insert(effect_of(part));
  return names;
}

/// "height_mm: liquid=milk_tea, distance_mm=400" → milk_tea
std::optional<std::string> liquid_of(const std::string& stratum) {
  const std::string key = "liquid=";
  const std::size_t at = stratum.find(key);
  if (at == std::string::npos) return std::nullopt;
  const std::string rest = stratum.substr(at + key.size());
  return rest.substr(0, rest.find_first_of(", "));
}

void read_effects(const JsonReader& report, Answer& answer) {
  for (const JsonReader& effect : report.items_or_none("effects")) {
    const std::string name = effect_of(effect.text("name"));
    answer.named.insert(name);
    if (!effect.has("parameters")) continue;
    for (const auto& [parameter, estimate] : effect.at("parameters").value().items()) {
      if (!estimate.contains("ci95") || !estimate["ci95"][0].is_number() || !estimate["ci95"][1].is_number()) continue;
      answer.parameters[name][parameter] = {estimate.value("value", 0.0), estimate["ci95"][0].get<double>(),
                                            estimate["ci95"][1].get<double>()};
    }
  }
}

void read_size_errors(const JsonReader& report, Answer& answer) {
  for (const JsonReader& error : report.items_or_none("size_errors"))
    if (!error.has("liquid"))
      answer.size_errors[error.text("name")][error.text("parameter")] = error.number("standard_error");
}

void read_ambiguity(const JsonReader& report, Answer& answer) {
  for (const JsonReader& item : report.items_or_none("ambiguity_set")) {
    Answer::Explanation explanation{{names_of(item.at("effects").value())}, {}, item.number("probability")};
    for (const JsonReader& other : item.items_or_none("indistinguishable"))
      explanation.sets.push_back(names_of(other.value()));
    for (const JsonReader& superset : item.items_or_none("supersets"))
      explanation.supersets.push_back(names_of(superset.value()));
    answer.ambiguity_set.push_back(explanation);
  }
  std::stable_sort(answer.ambiguity_set.begin(), answer.ambiguity_set.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
}

void read_next(const std::filesystem::path& file, Answer& answer) {
  const Json json = read_json(file);
  for (const JsonReader& item : JsonReader(json, file.string()).items()) {
    const std::vector<JsonReader> pair = item.at("separates").items();
    if (pair.size() != 2) item.fail_at("separates", "must name two sets of effects");
    answer.next.push_back({item.text("measurement"), item.text_or("campaign", ""), names_of_set(pair[0].text()),
                           names_of_set(pair[1].text()), item.number("sigma")});
  }
}

}  // namespace

bool Answer::Explanation::leaves_open_together(const Names& effects) const {
  return std::any_of(sets.begin(), sets.end(), [&](const Names& set) {
    if (!std::includes(effects.begin(), effects.end(), set.begin(), set.end())) return false;
    Names open = set;
    for (const Names& superset : supersets)
      if (superset.size() == set.size() + 1 && std::includes(superset.begin(), superset.end(), set.begin(), set.end()))
        open.insert(superset.begin(), superset.end());
    return std::includes(open.begin(), open.end(), effects.begin(), effects.end());
  });
}

double Answer::probability_of(const Names& effects) const {
  for (const Explanation& explanation : ambiguity_set)
    if (std::find(explanation.sets.begin(), explanation.sets.end(), effects) != explanation.sets.end())
      return explanation.probability;
  return 0.0;
}

Answer read_answer(const std::filesystem::path& folder) {
  Answer answer;
  const std::filesystem::path file = folder / "report.json";
  if (!std::filesystem::exists(file)) {
    answer.verdict = "missing";
    return answer;
  }
  const Json json = read_json(file);
  const JsonReader report(json, file.string());
  answer.verdict = report.text("verdict");
  read_effects(report, answer);
  read_size_errors(report, answer);
  read_ambiguity(report, answer);
  constexpr double kSignificant = 0.01;
  for (const JsonReader& where : report.items_or_none("where"))
    if (where.number("p") < kSignificant) {
      if (const auto liquid = liquid_of(where.text("stratum")))
        answer.liquids_in_gap.insert(*liquid);
      else
        answer.gap_in_all_liquids = true;
    }
  for (const JsonReader& warning : report.items_or_none("warnings")) answer.warnings += warning.text() + "\n";
  if (report.has("gap") && report.at("gap").has("held_out")) {
    const JsonReader held_out = report.at("gap").at("held_out");
    answer.before_rms = held_out.number_or("before_rms_mm", 0.0);
    answer.after_rms = held_out.number_or("after_rms_mm", 0.0);
    answer.noise_floor = held_out.number_or("noise_floor_mm", 0.0);
  }
  if (std::filesystem::exists(folder / "next.json")) read_next(folder / "next.json", answer);
  return answer;
}

}  // namespace fathom::blind
