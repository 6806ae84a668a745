#include "report/diagnosis_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/files.h"
#include "diagnosis/statistics/evidence.h"
#include "diagnosis/statistics/groups.h"
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

/// "2·10⁻⁵", "0.03"
std::string p_words(double p) {
  constexpr double kPlain = 0.001;
  if (p >= kPlain) return fmt::format("{:.1g}", p);
  if (!(p > 0.0)) return "0";
  constexpr std::string_view kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const std::string text = fmt::format("{:.0e}", p);  // "2e-05"
  std::string exponent;
  for (const char c : std::to_string(std::stoi(text.substr(text.find('-') + 1)))) exponent += kDigits[c - '0'];
  return fmt::format("{}·10⁻{}", text.front(), exponent);
}

/// Shares of 1 as whole per cent that sum to 100: the largest remainders are rounded up.
std::vector<int> percents_of(const std::vector<double>& shares) {
  std::vector<int> percents;
  for (const double share : shares) percents.push_back(static_cast<int>(std::floor(100.0 * share)));
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return 100.0 * shares[a] - percents[a] > 100.0 * shares[b] - percents[b];
  });
  int left = 100 - std::accumulate(percents.begin(), percents.end(), 0);
  for (std::size_t i = 0; i < order.size() && left > 0; ++i, --left) ++percents[order[i]];
  return percents;
}

/// A value and its σ with the same digits: two of the σ.
std::string value_words(double value, double sigma, std::string_view unit) {
  const int decimals = decimals_of(-sigma, sigma);
  return fmt::format("{:+.{}f} ± {:.{}f}{}", value, decimals, sigma, decimals, unit);
}

std::string where_html(const std::vector<GapLocation>& locations) {
  if (locations.empty())
    return paragraph(
        "No single quantity or group of conditions departs significantly from the model. An effect that is spread "
        "over many conditions can be found all the same.");
  std::vector<double> shares;
  for (const GapLocation& where : locations) shares.push_back(where.share_of_gap);
  shares.push_back(std::max(1.0 - std::accumulate(shares.begin(), shares.end(), 0.0), 0.0));
  const std::vector<int> percents = percents_of(shares);
  Rows rows;
  for (std::size_t i = 0; i < locations.size(); ++i) {
    const GapLocation& where = locations[i];
    const std::string_view unit = observable_words(where.observable).unit;
    rows.push_back({stratum_words(where), fmt::format("{:+.2g}{}", where.departure, unit),
                    value_words(where.mean, where.sigma, unit), fmt::format("{} %", percents[i]), p_words(where.p)});
  }
  if (percents.back() > 0)
    rows.push_back({"elsewhere, too thinly spread to be placed", "", "", fmt::format("{} %", percents.back()), ""});
  return html_table({"where", "plain mean of measured − model", "offset fitted beside the other rows (± 1 σ)",
                     "share of the misfit", "p that errors alone make it"},
                    rows) +
         paragraph(
             "The offsets are fitted together, weighted by the errors. The shares are of the squared misfit in units "
             "of the errors. Each p allows for all places that were looked at. A liquid is listed, too, if the heights "
             "in it, taken alone, depart as the best explanation has it. Then p is that of this agreement.");
}

std::string effects_html(const Diagnosis& diagnosis) {
  std::string html;
  for (const NamedEffect& named : diagnosis.effects) {
    const Effect* effect = find_effect(effect_name(named.name).id);
    std::vector<std::string> lines;
    const bool is_said = effect && !effect->more.empty() && named.parameters.size() == 1;
    if (!is_said)
      for (const NamedParameter& parameter : shown_parameters(named)) lines.push_back(parameter_words(parameter));
    lines.push_back(fmt::format("The probability that it is present is {}.", percent_words(named.probability, true)));
    constexpr double kWeak = 0.05;
    lines.push_back(fmt::format(
        "Errors alone give as strong a signal with p = {}, all effects that were tested counted.{}",
        p_words(named.p_discovery),
        named.p_discovery > kWeak ? " So it is present because all data together ask for it, not by a clear signal of "
                                    "its own."
                                  : ""));
    lines.push_back(
        fmt::format("In conditions that were held out of the fit they do with p = {}.", p_words(named.p_confirmation)));
    if (effect && !effect->citation.empty()) lines.push_back(fmt::format("Literature: {}.", effect->citation));
    html += fmt::format("<h3>{}</h3>\n", html_escaped(effect_words(named.name))) +
            paragraph(capitalised(effect_clause(named)) + ".") + list(lines);
  }
  return html;
}

/// What "before" and "after" mean.
std::string after_words(const Diagnosis& diagnosis) {
  const bool is_named = !diagnosis.effects.empty();
  const bool is_likeliest = !is_named && diagnosis.verdict == Verdict::ambiguous;
  std::vector<std::string> added;
  for (const NamedEffect& effect : diagnosis.effects) added.push_back(effect.name);
  if (is_likeliest) added = diagnosis.ambiguity_set.front().effects;
  return fmt::format(
      "Before: the model as the rig describes it. After: {}, and whatever the laboratory states with a σ moved within "
      "it to where it fits best. Held out: each group of conditions is predicted by a fit to the others.",
      added.empty()  ? "no effect added"
      : is_likeliest ? fmt::format("with the likeliest explanation, {}", effects_words(added))
                     : fmt::format("with {} added", effects_words(added)));
}

/// Levels of factors that have several, each once: bare of liquid an empty cup is its fill of 0.
bool is_worth_a_row(const StratumGap& stratum, const std::vector<StratumGap>& all) {
  const auto factor = [](const StratumGap& s) { return s.stratum.substr(0, s.stratum.find('=')); };
  const auto has = [&](const auto& is) { return std::any_of(all.begin(), all.end(), is); };
  if (stratum.stratum == "fill_mm=0" && has([](const StratumGap& s) { return s.stratum == "liquid=empty"; }))
    return false;
  return has([&](const StratumGap& s) { return s.stratum != stratum.stratum && factor(s) == factor(stratum); });
}

std::string gap_html(const Diagnosis& diagnosis) {
  const auto row = [](std::string name, const GapSize& train, const GapSize& held_out) {
    std::vector<std::string> cells{std::move(name)};
    for (const double mm : {train.before_rms_mm, train.after_rms_mm, train.noise_floor_mm, held_out.after_rms_mm,
                            held_out.noise_floor_mm})
      cells.push_back(fmt::format("{:.2f}", mm));
    return cells;
  };
  Rows rows{row("all", diagnosis.gap.train, diagnosis.gap.held_out)};
  for (const StratumGap& stratum : diagnosis.gap.strata)
    if (is_worth_a_row(stratum, diagnosis.gap.strata))
      rows.push_back(row(place_words(stratum.stratum), stratum.train, stratum.held_out));
  return html_table({heights_words(diagnosis) + ", root mean square [mm]", "before", "after", "errors alone",
                     "held out", "errors alone, held out"},
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
    return next.settles() ? next.measurement : "nothing that was simulated";
  }
  return "";
}

/// "every pour is 15 % (13 to 17 %) larger than recorded"; nothing of an explanation that was not fitted, or too small
/// for its size to be known.
std::string clauses_of(const Explanation& explanation) {
  if (explanation.is_too_small) return "";
  std::vector<std::string> clauses;
  for (std::size_t i = 0; i < explanation.sizes.size(); ++i)
    clauses.push_back(effect_clause({explanation.effects[i], explanation.sizes[i]}));
  return fmt::format("{}", fmt::join(clauses, "; "));
}

std::string rivals_html(const Diagnosis& diagnosis) {
  Rows rows, details;
  for (const Explanation& explanation : diagnosis.ambiguity_set) {
    std::vector<std::string> twins;
    for (const auto& twin : explanation.alternatives) twins.push_back(effects_words(twin));
    const std::string words =
        effects_words(explanation.effects) + (explanation.is_too_small ? ", too small to show" : "");
    const bool is_first = &explanation == &diagnosis.ambiguity_set.front();
    rows.push_back({words, clauses_of(explanation), fmt::format("{:.1f} %", 100 * explanation.probability),
                    some_of(std::move(twins)), is_first ? "" : what_would_settle(explanation, diagnosis)});
    if (std::string beside = beside_words(explanation); !beside.empty())
      details.push_back({words, fmt::format("{:.1f} %", 100 * explanation.alone), std::move(beside)});
  }
  std::string html = folded_table({"explanation", "fitted to these measurements (95 %)", "probability",
                                   "looks the same in these measurements", "what would tell it from the first"},
                                  rows);
  if (!details.empty())
    html += html_folded(
        "What may be there besides",
        html_table({"explanation", "probability that nothing else is there", "may be there as well"}, details));
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
  return is_beyond_bounds(limit, departure) ? "any amount"
                                            : fmt::format("{:.3g}{}", departure, parameter_unit(limit.parameter));
}

std::string limits_html(const std::vector<UpperLimit>& limits) {
  Rows rows;
  std::vector<std::string> hidden;
  for (const UpperLimit& limit : limits)
    if (is_beyond_bounds(limit, limit.limit95) && is_beyond_bounds(limit, limit.smallest_seen))
      hidden.push_back(fmt::format("{} ({})", effect_words(limit.effect), parameter_name(limit.parameter)));
    else
      rows.push_back({effect_words(limit.effect), parameter_name(limit.parameter),
                      departure_words(limit, limit.limit95), departure_words(limit, limit.smallest_seen)});
  std::string html;
  if (!rows.empty())
    html += html_table(
        {"effect", "its", "could differ from the model by up to (95 %)", "raises an alarm half the time from"}, rows);
  if (!hidden.empty())
    html += paragraph(
        fmt::format("However large, these would not show in these measurements: {}.", fmt::join(hidden, ", ")));
  return html;
}

/// The effects' ids, each once: in which liquid they are makes no other effect of them.
std::set<std::string> ids_of(const std::vector<std::string>& effects) {
  std::set<std::string> ids;
  for (const std::string& effect : effects) ids.insert(effect_name(effect).id);
  return ids;
}

/// Whether a person meets one of the effects on the page.
bool is_spoken_of(const std::set<std::string>& ids, const Diagnosis& diagnosis) {
  const auto holds = [&](const std::vector<std::string>& effects) {
    return std::any_of(effects.begin(), effects.end(),
                       [&](const std::string& effect) { return ids.contains(effect_name(effect).id); });
  };
  constexpr double kLikely = 0.02;
  return std::any_of(diagnosis.ambiguity_set.begin(), diagnosis.ambiguity_set.end(),
                     [&](const Explanation& e) { return e.probability >= kLikely && holds(e.effects); });
}

std::string confusable_html(const Diagnosis& diagnosis) {
  const Limits& limits = diagnosis.limits;
  std::set<std::set<std::string>> known;
  const auto is_new = [&](const std::set<std::string>& ids) { return ids.size() > 1 && known.insert(ids).second; };
  Rows rows;
  for (const ConfusablePair& pair : limits.confusable)
    if (is_new(ids_of({pair.first, pair.second})))
      rows.push_back({effect_words(pair.first), effect_words(pair.second), fmt::format("{:.1f}°", pair.angle_deg)});
  std::string html;
  if (!rows.empty())
    html += html_table({"effect", "changes these measurements much as", "angle between (0°: the same)"}, rows);
  std::vector<std::string> hidden;
  for (const NearNullDirection& direction : limits.near_null)
    if (const std::set<std::string> ids = ids_of(direction.effects); is_new(ids) && is_spoken_of(ids, diagnosis))
      hidden.push_back(effects_words({ids.begin(), ids.end()}));
  if (!hidden.empty()) html += paragraph("Where these act together, their changes nearly cancel:") + list(hidden);
  return html.empty() ? "" : html_folded("Effects that these measurements hardly tell apart", html);
}

std::string next_html(const Diagnosis& diagnosis) {
  Rows rows, open;
  for (const NextMeasurement& next : diagnosis.next)
    (next.settles() ? rows : open)
        .push_back({effects_words(next.separates[0]), effects_words(next.separates[1]), next.measurement,
                    fmt::format("{:.1f} σ", next.sigma), fmt::format("{:.0f} min", next.cost)});
  std::string html;
  if (!rows.empty()) html += folded_table({"to tell", "from", "measure", "separation", "time"}, rows);
  if (!open.empty())
    html += html_folded("Pairs that no measurement that was simulated tells apart (3 σ)",
                        html_table({"explanation", "from", "best measurement", "separation", "time"}, open));
  return html;
}

std::string budget_html(const Diagnosis& diagnosis) {
  const bool is_traced = !diagnosis.budget.empty() && diagnosis.budget.front().surrogate_difference;
  std::vector<ConditionBudget> lines = diagnosis.budget;
  const auto in_errors = [](const ConditionBudget& line) {
    return line.u_validation > 0.0 ? std::abs(line.comparison_error) / line.u_validation : 0.0;
  };
  std::stable_sort(lines.begin(), lines.end(),
                   [&](const ConditionBudget& a, const ConditionBudget& b) { return in_errors(a) > in_errors(b); });
  Rows rows;
  for (const ConditionBudget& line : lines)
    rows.push_back({line.condition, fmt::format("{}", observable_words(line.observable).name),
                    fmt::format("{:+.3f}{}", line.comparison_error, observable_words(line.observable).unit),
                    fmt::format("{:.1f}", in_errors(line)), fmt::format("{:.3f}", line.u_data),
                    fmt::format("{:.3f}", line.u_input), fmt::format("{:.3f}", line.u_numerical),
                    fmt::format("{:.3f}", line.u_validation)});
  return html_folded(
      fmt::format("{} rows, one for each condition and quantity, largest |E| / u_val first", rows.size()),
      paragraph(fmt::format("ASME V&V 20: E = measured − model; u_val is its uncertainty, of data (u_D), inputs and "
                            "numerics. All are in the unit of E.{}",
                            is_traced ? " u_num is by how much few rays differ from ray tracing." : "")) +
          html_table({"condition", "quantity", "E", "|E| / u_val", "u_D", "u_input", "u_num", "u_val"}, rows, true));
}

/// "2 sessions", "1 pour"; nothing of none.
std::string count_words(std::size_t count, std::string_view name) {
  return count == 0 ? "" : fmt::format("{} {}{}", count, name, count == 1 ? "" : "s");
}

/// The last name of a path, whether or not it ends with a slash.
std::string last_name(const std::filesystem::path& path) {
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

/// What was measured, in a sentence.
std::string facts_words(const std::vector<Observation>& observations) {
  std::set<int> sessions;
  std::set<std::string> pours, placements, liquids;
  for (const Observation& o : observations) {
    const Factors& f = o.factors;
    sessions.insert(f.session);
    if (o.observable != "height_mm") continue;
    placements.insert(placement_key(o));
    liquids.insert(f.liquid == "empty" ? "empty cups" : spaced(f.liquid));
    if (has_liquid(f)) pours.insert(pour_of(f));
  }
  std::vector<std::string> parts;
  for (std::string part : {count_words(sessions.size(), "session"), count_words(pours.size(), "pour"),
                           count_words(placements.size(), "placement"), count_words(observations.size(), "mean")})
    if (!part.empty()) parts.push_back(std::move(part));
  return fmt::format("Compared: {}{}{}.", fmt::join(parts, ", "), liquids.empty() ? "" : "; ",
                     fmt::join(liquids, ", "));
}

std::string unknown_html(const Diagnosis& diagnosis) {
  const UnknownShape& unknown = diagnosis.unknown;
  std::string html;
  if (!unknown.formula.empty())
    html += paragraph(
        fmt::format("The formula in place, fill and distance that fits what is left best: {}.", unknown.formula));
  if (!unknown.most_similar.empty())
    html +=
        paragraph(fmt::format("Of the effects in the list it resembles {} most, with a cosine of {:.2f} between "
                              "their changes (1: the same).",
                              effect_words(unknown.most_similar), unknown.similarity));
  return html.empty() ? "" : html_folded("What is known of the unknown", html);
}

}  // namespace

void write_diagnosis_report(const std::filesystem::path& folder, const DiagnosedCampaign& campaign) {
  const Diagnosis& diagnosis = campaign.diagnosis;
  std::vector<std::string> names;
  for (const std::string& measurement : campaign.folders) names.push_back(last_name(measurement));
  std::string html =
      fmt::format("<h1>Diagnosis of {}</h1>\n<p class=\"answer\">{}</p>\n",
                  html_escaped(fmt::format("{}", fmt::join(names, " and "))), html_escaped(finding(diagnosis)));
  if (const std::vector<std::string> steps = advice(diagnosis); !steps.empty())
    html += heading("What to do now") + list(steps);
  if (!diagnosis.data.mistakes.empty())
    html += heading("What was written down wrongly") + mistakes_html(diagnosis.data.mistakes);
  if (!diagnosis.data.warnings.empty()) html += heading("What limits this") + list(diagnosis.data.warnings);
  const std::string notes = (campaign.notes.empty() ? "" : heading("Notes") + list(campaign.notes)) +
                            paragraph(facts_words(campaign.observations)) +
                            paragraph(fmt::format("Measured data: {}.", fmt::join(campaign.folders, " and ")));
  if (diagnosis.verdict == Verdict::insufficient) {
    write_text(folder / "report.html", html_page("Fathom: diagnosis", html + notes));
    return;
  }
  html += heading("Where measurement and model differ") + where_html(diagnosis.departures.where);
  if (const MapPicture map = draw_map(folder, campaign); map.is_drawn)
    html += html_picture(folder / "map.png", "Mean difference by region") +
            (map.has_unseen ? paragraph("Grey: no height was measured there, mostly because the cup's wall hides it "
                                        "from the camera or from the projector.")
                            : "");
  if (draw_shape(folder, campaign))
    html += html_picture(folder / "shape.png", "Shape of what is seen in the cup, by liquid") +
            paragraph(
                "Measured minus model of each square of the cup's inside, less the mean of its squares, averaged over "
                "all places of the cup. A square that is missing was seen in too few places.");
  if (draw_sessions(folder, campaign))
    html += html_picture(folder / "sessions.png", "Height of the camera above the desk, by session and time") +
            paragraph("Each dot is one placement or one view of the bare desk.");
  if (!diagnosis.effects.empty()) html += heading("What was found") + effects_html(diagnosis);
  html += unknown_html(diagnosis) + heading("Before and after") + paragraph(after_words(diagnosis));
  if (draw_heights(folder, campaign)) html += heights_chart(campaign);
  html += gap_html(diagnosis);
  if (!campaign.ray_traced_html.empty()) html += heading("Few rays and ray tracing") + campaign.ray_traced_html;
  html += heading("Possible explanations") + rivals_html(diagnosis) + confusable_html(diagnosis);
  if (!diagnosis.next.empty()) html += heading("What to measure next") + next_html(diagnosis);
  html += heading("How large other effects could still be") +
          html_folded("Effects that were not found", limits_html(diagnosis.limits.upper));
  html += heading("Uncertainty budget") + budget_html(diagnosis);
  write_residuals(folder, campaign);
  html +=
      "<p>All measured values and what the model leaves of them: <a href=\"residuals.csv\">residuals.csv</a>.</p>\n";
  write_text(folder / "report.html", html_page("Fathom: diagnosis", html + notes));
}

}  // namespace fathom
