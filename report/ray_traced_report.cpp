#include "report/ray_traced_report.h"

#include <fmt/format.h>

#include "diagnosis/decision/diagnosis_json.h"
#include "report/diagnosis_words.h"
#include "report/html.h"

namespace fathom {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// In the first set that has the effect.
const SensitivityCheck* check_of(const RayTracedDiagnosis& traced, const std::string& effect) {
  for (const TracedSet& set : traced.sets)
    for (const SensitivityCheck& check : set.checks)
      if (check.effect == effect) return &check;
  return nullptr;
}

std::string checks_html(const RayTracedDiagnosis& traced) {
  Rows rows;
  for (const TracedSet& set : traced.sets)
    for (const SensitivityCheck& check : set.checks)
      rows.push_back({effects_words(set.effects), effect_words(check.effect), fmt::format("{:.3f}", check.cosine),
                      check.is_fit() ? "may" : "unfit"});
  return html_table({"set that was traced", "effect", "cosine of its sensitivities", "few rays stand for it"}, rows);
}

void add_values(const char* by, const Diagnosis& diagnosis, Rows& rows) {
  std::string effects;
  for (const NamedEffect& effect : diagnosis.effects) {
    std::vector<std::string> sizes;
    for (const NamedParameter& parameter : shown_parameters(effect)) sizes.push_back(parameter_words(parameter));
    effects +=
        (effects.empty() ? "" : "; ") + effect_words(effect.name) + (sizes.empty() ? "" : ": ") + joined(sizes, "and");
  }
  rows.push_back({by, std::string(name_of(diagnosis.verdict)), effects.empty() ? "nothing" : effects,
                  fmt::format("{:.3f}", diagnosis.gap.train.before_rms_mm),
                  fmt::format("{:.3f}", diagnosis.gap.train.after_rms_mm),
                  fmt::format("{:.3f}", diagnosis.gap.held_out.after_rms_mm),
                  fmt::format("{:.3f}", diagnosis.gap.train.noise_floor_mm)});
}

}  // namespace

void add_ray_traced(const RayTracedDiagnosis& traced, const Diagnosis& by_few_rays, Json& report) {
  for (std::size_t i = 0; i < traced.diagnosis.effects.size(); ++i)
    if (const SensitivityCheck* check = check_of(traced, traced.diagnosis.effects[i].name)) {
      Json& effect = report["effects"][traced.diagnosis.data.mistakes.size() + i];
      effect["cosine"] = check->cosine;
      effect["fit"] = check->is_fit();
    }
  Json& json = report["ray_traced"];
  json = {{"sets", Json::array()},
          {"left_out", Json::array()},
          {"observations_not_seen", traced.not_seen},
          {"sets_not_traced", traced.not_traced}};
  for (const TracedSet& set : traced.sets) {
    Json checks = Json::array();
    for (const SensitivityCheck& check : set.checks)
      checks.push_back({{"name", check.effect}, {"cosine", check.cosine}, {"fit", check.is_fit()}});
    json["sets"].push_back(std::move(checks));
  }
  for (const LeftOutLevel& level : traced.left_out) {
    Json entry = json_from(level.gap);
    entry["stratum"] = level.stratum;
    json["left_out"].push_back(std::move(entry));
  }
  const Json before = json_from(by_few_rays);
  report["geometric"] = {{"verdict", before["verdict"]},
                         {"answer", answer(by_few_rays)},
                         {"effects", before["effects"]},
                         {"gap", before["gap"]}};
}

std::string ray_traced_html(const RayTracedDiagnosis& traced, const Diagnosis& by_few_rays) {
  Rows models;
  add_values("few rays", by_few_rays, models);
  add_values("ray tracing", traced.diagnosis, models);
  std::string html =
      html_table({"predicted by", "verdict", "found", "heights before [mm]", "after", "held out", "errors"}, models);
  html += checks_html(traced);
  Rows levels;
  for (const LeftOutLevel& level : traced.left_out)
    levels.push_back({level.stratum, fmt::format("{:.3f}", level.gap.before_rms_mm),
                      fmt::format("{:.3f}", level.gap.after_rms_mm), fmt::format("{:.3f}", level.gap.noise_floor_mm)});
  if (!levels.empty())
    html += html_table({"heights where, by a fit without them [mm]", "before", "after", "errors"}, levels, true);
  if (traced.not_seen > 0)
    html +=
        fmt::format("<p>{} observations are not seen in simulated frames and were left out.</p>\n", traced.not_seen);
  if (traced.not_traced > 0)
    html += fmt::format("<p>{} more sets would have taken too long to trace.</p>\n", traced.not_traced);
  return html;
}

}  // namespace fathom
