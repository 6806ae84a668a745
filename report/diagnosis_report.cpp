#include "report/diagnosis_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/files.h"
#include "diagnosis/statistics/evidence.h"
#include "report/diagnosis_pictures.h"
#include "report/diagnosis_words.h"
#include "report/heights_chart.h"
#include "report/html.h"
#include "report/observable_words.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string paragraph(const std::string& text) { return fmt::format("<p>{}</p>\n", html_escaped(text)); }
std::string heading(const char* text) { return fmt::format("<h2>{}</h2>\n", text); }

std::string list(const std::vector<std::string>& items) {
  std::string html = "<ul>\n";
  for (const std::string& item : items) html += fmt::format("<li>{}</li>\n", html_escaped(item));
  return html + "</ul>\n";
}

std::string mistakes_html(const std::vector<Mistake>& mistakes) {
  Rows rows;
  for (const Mistake& mistake : mistakes) rows.push_back({effect_words(mistake.id), mistake.sentence});
  return html_table({"mistake", "what was found, and put right for all that follows"}, rows);
}

/// The first rows stand; what follows them waits behind a click.
std::string folded_table(const std::vector<std::string>& head, const Rows& rows) {
  constexpr std::size_t kShown = 8;
  const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, rows.size()));
  std::string html = html_table(head, {rows.begin(), middle});
  if (middle != rows.end())
    html += html_folded(fmt::format("{} more", rows.end() - middle), html_table(head, {middle, rows.end()}));
  return html;
}

std::string where_html(const std::vector<GapLocation>& locations) {
  if (locations.empty()) return paragraph("No part of the measurements departs from the model for sure.");
  Rows rows;
  double left = 1.0;
  for (const GapLocation& where : locations) {
    const std::string_view unit = observable_words(where.observable).unit;
    rows.push_back({stratum_words(where), fmt::format("{:+.2g}{}", where.departure, unit),
                    fmt::format("{:+.2g} ± {:.1g}{}", where.mean, where.sigma, unit),
                    fmt::format("{:.0f} %", 100 * where.share_of_gap), fmt::format("{:.1g}", where.p)});
    left -= where.share_of_gap;
  }
  if (left >= 0.005)
    rows.push_back({"elsewhere, too thinly spread to be placed", "", "", fmt::format("{:.0f} %", 100 * left), ""});
  return paragraph(
             "What is of its own is what would be left if the other lines were put right. The shares are of the whole "
             "gap, in squared errors.") +
         html_table(
             {"where", "mean of measured − model", "of its own", "share of the gap", "p that errors alone make it"},
             rows);
}

std::string effects_html(const Diagnosis& diagnosis) {
  std::string html;
  for (const NamedEffect& named : diagnosis.effects) {
    const Effect* effect = find_effect(effect_name(named.name).id);
    std::vector<std::string> lines;
    for (const NamedParameter& parameter : shown_parameters(named)) lines.push_back(parameter_words(parameter));
    lines.push_back(fmt::format("It is there with a probability of {:.1f} %.", 100 * named.probability));
    lines.push_back(
        fmt::format("Errors alone make as much, for any effect in the list, with p = {:.1g}.", named.p_discovery));
    lines.push_back(fmt::format("In conditions that had no part in finding its size they do with p = {:.1g}.",
                                named.p_confirmation));
    if (effect && !effect->citation.empty()) lines.push_back(fmt::format("Source: {}.", effect->citation));
    html += fmt::format("<h3>{}</h3>\n", html_escaped(effect_words(named.name))) +
            paragraph(capitalised(effect_clause(named)) + ".") + list(lines);
  }
  return html;
}

std::string gap_html(const Diagnosis& diagnosis) {
  const auto row = [](const char* name, const GapSize& gap) {
    return std::vector<std::string>{name, fmt::format("{:.3f}", gap.before_rms_mm),
                                    fmt::format("{:.3f}", gap.after_rms_mm), fmt::format("{:.3f}", gap.noise_floor_mm)};
  };
  std::string html =
      html_table({heights_words(diagnosis) + ", root mean square [mm]", "before", "after", "expected of errors alone"},
                 {row("all conditions", diagnosis.gap.train),
                  row("each group of conditions, fitted without it", diagnosis.gap.held_out)},
                 true);
  Rows rows;
  for (const StratumGap& stratum : diagnosis.gap.strata)
    rows.push_back({place_words(stratum.stratum), fmt::format("{:.3f}", stratum.train.before_rms_mm),
                    fmt::format("{:.3f}", stratum.train.after_rms_mm),
                    fmt::format("{:.3f}", stratum.held_out.after_rms_mm),
                    fmt::format("{:.3f}", stratum.train.noise_floor_mm)});
  return html +
         html_table({heights_words(diagnosis) + ", root mean square [mm]", "before", "after", "held out", "errors"},
                    rows, true);
}

/// "a; b; 5 more"
std::string some_of(std::vector<std::string> words) {
  constexpr std::size_t kShown = 6;
  const std::size_t more = words.size() > kShown ? words.size() - kShown : 0;
  words.resize(words.size() - more);
  return fmt::format("{}{}", fmt::join(words, "; "), more > 0 ? fmt::format("; {} more", more) : "");
}

/// What its supersets add to an explanation, likeliest first.
std::string beside_words(const Explanation& explanation) {
  std::vector<std::string> added;
  for (const std::vector<std::string>& superset : explanation.supersets)
    for (const std::string& effect : superset)
      if (std::find(explanation.effects.begin(), explanation.effects.end(), effect) == explanation.effects.end())
        if (std::string words = effect_words(effect); std::find(added.begin(), added.end(), words) == added.end())
          added.push_back(std::move(words));
  return some_of(std::move(added));
}

/// Which measurement would tell an explanation from the likeliest one.
std::string what_would_settle(const Explanation& explanation, const Diagnosis& diagnosis) {
  const std::vector<std::string>& first = diagnosis.ambiguity_set.front().effects;
  for (const NextMeasurement& next : diagnosis.next) {
    const std::vector<std::string>&one = next.separates[0], &other = next.separates[1];
    if ((one != first || other != explanation.effects) && (other != first || one != explanation.effects)) continue;
    return next.settles() ? fmt::format("{} ({:.0f} min): {:.1f} σ", next.measurement, next.cost, next.sigma)
                          : fmt::format("nothing that was considered: {:.1f} σ at most", next.sigma);
  }
  return "";
}

std::string rivals_html(const Diagnosis& diagnosis) {
  Rows rows, details;
  for (const Explanation& explanation : diagnosis.ambiguity_set) {
    std::vector<std::string> twins;
    for (const auto& twin : explanation.alternatives) twins.push_back(effects_words(twin));
    const std::string words =
        effects_words(explanation.effects) + (explanation.is_too_small ? ", too small to show" : "");
    const bool is_first = &explanation == &diagnosis.ambiguity_set.front();
    rows.push_back({words, fmt::format("{:.1f} %", 100 * explanation.probability), some_of(std::move(twins)),
                    is_first ? "" : what_would_settle(explanation, diagnosis)});
    if (std::string beside = beside_words(explanation); !beside.empty())
      details.push_back({words, fmt::format("{:.1f} %", 100 * explanation.alone), std::move(beside)});
  }
  std::string html = folded_table(
      {"explanation", "probability", "looks the same in these measurements", "what would tell it from the first"},
      rows);
  if (!details.empty())
    html +=
        html_folded("What may be there besides", html_table({"explanation", "alone", "may be there as well"}, details));
  return html;
}

/// Whether a parameter cannot depart from its nominal value any farther than this.
bool is_beyond_bounds(const UpperLimit& limit, double departure) {
  const Effect* effect = find_effect(effect_name(limit.effect).id);
  if (!effect) return false;
  const auto p = std::find_if(effect->parameters.begin(), effect->parameters.end(),
                              [&](const EffectParameter& parameter) { return parameter.name == limit.parameter; });
  return p != effect->parameters.end() && departure >= std::max(p->upper - p->nominal, p->nominal - p->lower);
}

std::string departure_words(const UpperLimit& limit, double departure) {
  return is_beyond_bounds(limit, departure) ? "not visible here" : fmt::format("{:.3g}", departure);
}

std::string limits_html(const std::vector<UpperLimit>& limits) {
  Rows rows;
  for (const UpperLimit& limit : limits)
    rows.push_back({effect_words(limit.effect), limit.parameter, departure_words(limit, limit.limit95),
                    departure_words(limit, limit.smallest_seen)});
  return html_table({"effect", "parameter", "departs by less than (95 %)", "would be named half the time at"}, rows);
}

/// The effects' ids, each once: in which liquid they are makes no other effect of them.
std::set<std::string> ids_of(const std::vector<std::string>& effects) {
  std::set<std::string> ids;
  for (const std::string& effect : effects) ids.insert(effect_name(effect).id);
  return ids;
}

std::string confusable_html(const Limits& limits) {
  std::set<std::set<std::string>> known;
  const auto is_new = [&](const std::set<std::string>& ids) { return ids.size() > 1 && known.insert(ids).second; };
  Rows rows;
  for (const ConfusablePair& pair : limits.confusable)
    if (is_new(ids_of({pair.first, pair.second})))
      rows.push_back({effect_words(pair.first), effect_words(pair.second), fmt::format("{:.1f}°", pair.angle_deg)});
  std::string html;
  if (!rows.empty()) html += html_table({"effect", "changes these measurements almost as", "angle"}, rows);
  std::vector<std::string> hidden;
  for (const NearNullDirection& direction : limits.near_null)
    if (const std::set<std::string> ids = ids_of(direction.effects); is_new(ids))
      hidden.push_back(effects_words({ids.begin(), ids.end()}));
  if (!hidden.empty()) html += paragraph("Where these act together, their changes nearly cancel:") + list(hidden);
  return html.empty() ? "" : html_folded("Effects that these measurements hardly tell apart", html);
}

std::string next_html(const Diagnosis& diagnosis) {
  Rows rows;
  for (const NextMeasurement& next : diagnosis.next)
    rows.push_back({effects_words(next.separates[0]), effects_words(next.separates[1]),
                    next.settles() ? next.measurement : "none of these will settle it; the best is " + next.measurement,
                    fmt::format("{:.1f} σ", next.sigma), fmt::format("{:.0f} min", next.cost)});
  return folded_table({"to tell", "from", "measure", "by", "for"}, rows);
}

std::string budget_html(const Diagnosis& diagnosis) {
  const bool is_traced = !diagnosis.budget.empty() && diagnosis.budget.front().surrogate_difference;
  Rows rows;
  for (const ConditionBudget& line : diagnosis.budget)
    rows.push_back({line.condition, line.observable, fmt::format("{:+.3f}", line.comparison_error),
                    fmt::format("{:.3f}", line.u_data), fmt::format("{:.3f}", line.u_input),
                    fmt::format("{:.3f}", line.u_numerical), fmt::format("{:.3f}", line.u_validation)});
  return html_folded(
      fmt::format("{} conditions (ASME V&V 20: E = measured − model, its uncertainty u_val of data, inputs and "
                  "numerics{})",
                  rows.size(), is_traced ? "; u_num is by how much few rays differ from ray tracing" : ""),
      html_table({"condition", "observable", "E", "u_D", "u_input", "u_num", "u_val"}, rows, true));
}

}  // namespace

void write_diagnosis_report(const std::filesystem::path& folder, const DiagnosedCampaign& campaign) {
  const Diagnosis& diagnosis = campaign.diagnosis;
  std::string html = fmt::format("<h1>Where model and measurement differ: {}</h1>\n<p class=\"answer\">{}</p>\n",
                                 html_escaped(campaign.name), html_escaped(answer(diagnosis)));
  if (!diagnosis.data.mistakes.empty())
    html += heading("What was written down wrongly") + mistakes_html(diagnosis.data.mistakes);
  if (!diagnosis.data.warnings.empty()) html += heading("Look at this first") + list(diagnosis.data.warnings);
  if (!campaign.notes.empty()) html += heading("What limits this") + list(campaign.notes);
  if (diagnosis.verdict == Verdict::insufficient) {
    write_text(folder / "report.html", html_page("Fathom: diagnosis", html));
    return;
  }
  html += heading("Where") + where_html(diagnosis.departures.where);
  if (draw_map(folder, campaign))
    html += html_picture(folder / "map.png", "Mean difference by region") +
            paragraph("A grey part has no height: the cup's wall hides it from the camera or from the projector.");
  if (draw_shape(folder, campaign))
    html += html_picture(folder / "shape.png", "Shape of what is seen in the cup, by liquid") +
            paragraph(
                "Each square says by how much a part of the cup is higher than the mean of the squares, over all "
                "places of the cup.");
  if (!diagnosis.effects.empty()) html += heading("What the model lacked") + effects_html(diagnosis);
  html += heading("Before and after");
  if (diagnosis.verdict == Verdict::ambiguous && diagnosis.effects.empty())
    html += paragraph(fmt::format("After: with the likeliest explanation, {}.",
                                  effects_words(diagnosis.ambiguity_set.front().effects)));
  if (draw_heights(folder, campaign)) html += heights_chart(campaign);
  html += gap_html(diagnosis);
  if (!campaign.ray_traced_html.empty()) html += heading("Few rays and ray tracing") + campaign.ray_traced_html;
  html += heading("What else it could be") + rivals_html(diagnosis) + confusable_html(diagnosis.limits);
  if (!diagnosis.next.empty()) html += heading("What to measure next") + next_html(diagnosis);
  html += heading("What could still hide") + html_folded("Limits of every effect", limits_html(diagnosis.limits.upper));
  html += heading("Uncertainty budget") + budget_html(diagnosis);
  write_residuals(folder, campaign);
  html += "<p>Every observation: <code>residuals.csv</code>.</p>\n";
  write_text(folder / "report.html", html_page("Fathom: diagnosis", html));
}

}  // namespace fathom
