#include "report/diagnosis_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "diagnosis/statistics/decision_settings.h"
#include "diagnosis/statistics/evidence.h"
#include "report/observable_words.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

bool compares(const Diagnosis& diagnosis, std::string_view observable) {
  return std::any_of(diagnosis.budget.begin(), diagnosis.budget.end(),
                     [&](const ConditionBudget& line) { return line.observable == observable; });
}

std::string spaced(std::string_view words) {
  std::string text(words);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

struct Unit {
  std::string_view ending, words;
};
constexpr Unit kUnits[] = {{"_per_mm", " per mm"}, {"_per_min", " per min"}, {"_mm", " mm"},
                           {"_deg", "°"},          {"_px", " px"},           {"_degC", " °C"},
                           {"_s", " s"},           {"_min", " min"},         {"_mm_per_h", " mm per hour"}};

/// "tilt_x_deg" → "tilt x" and "°".
std::pair<std::string, std::string_view> without_unit(std::string_view name) {
  for (const Unit& unit : kUnits)
    if (name.ends_with(unit.ending)) return {spaced(name.substr(0, name.size() - unit.ending.size())), unit.words};
  return {spaced(name), ""};
}

std::string joined(const std::vector<std::string>& words, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? fmt::format(" {} ", last) : ", ") + words[i];
  return text;
}

/// "time=early" → "in the first third of the session"; nothing of what is no time.
std::string third_words(std::string_view stratum) {
  struct Words {
    std::string_view key, words;
  };
  constexpr Words kSpans[] = {{"time=", "the session"}, {"time_since_pour=", "the time since the pour"}};
  constexpr Words kThirds[] = {{"early", "first"}, {"middle", "middle"}, {"late", "last"}};
  for (const Words& span : kSpans)
    for (const Words& third : kThirds)
      if (stratum.starts_with(span.key) && stratum.substr(span.key.size()) == third.key)
        return fmt::format("in the {} third of {}", third.words, span.words);
  return {};
}

/// "Where liquid is milk tea, the height in the cup is 1.4 mm lower than the model has it.": where the gap is largest.
std::string where_sentence(const Diagnosis& diagnosis) {
  if (diagnosis.departures.where.empty()) return {};
  const GapLocation& where = diagnosis.departures.where.front();
  // Of a shape that nothing explains, unknown_sentence() says where it is.
  if (where.observable == "content_shape_mm" && !diagnosis.unknown.part.empty()) return {};
  const ObservableWords words = observable_words(where.observable);
  const std::string place = place_words(where.stratum);
  // What differs from place to place may have a mean of nothing where it differs most.
  const bool is_of_itself = where.departure * where.mean > 0.5 * where.mean * where.mean;
  const double size = is_of_itself ? where.departure : where.mean;
  return capitalised(fmt::format("{}the {} is {:.2g}{} {}{} than the model has it. ", place.empty() ? "" : place + ", ",
                                 words.name, std::abs(size), words.unit, size < 0 ? words.less : words.more,
                                 is_of_itself ? "" : ", beside the rest,"));
}

/// "15 % (13 to 17 %)": the size of a parameter's departure from nominal, whichever way it goes, with its 95 %
/// interval. "at least 2.3 px (3 px is the most that is considered)": where it ends at the parameter's bound.
std::string size_words(const NamedParameter& found, const EffectParameter& parameter, bool in_percent) {
  const double factor = (in_percent ? 100.0 : 1.0) * (found.value < parameter.nominal ? -1.0 : 1.0);
  const std::string_view unit = in_percent ? " %" : without_unit(found.name).second;
  const auto [low, high] =
      std::minmax({factor * (found.low95 - parameter.nominal), factor * (found.high95 - parameter.nominal)});
  const double size = factor * (found.value - parameter.nominal);
  const double most = factor * ((factor < 0.0 ? parameter.lower : parameter.upper) - parameter.nominal);
  if (size >= most * (1.0 - 1e-6))
    return fmt::format("at least {:.3g}{} ({:.3g}{} is the most that is considered)", low, unit, most, unit);
  return fmt::format("{:.3g}{} ({:.3g} to {:.3g}{})", size, unit, low, high, unit);
}

std::string named_sentence(const Diagnosis& diagnosis) {
  std::vector<std::string> clauses;
  for (const NamedEffect& effect : diagnosis.effects) clauses.push_back(effect_clause(effect));
  const GapSize& gap = diagnosis.gap.train;
  return fmt::format(
      "Best explanation: {}. With that in the model the {} differ by {:.2f} mm instead of {:.2f} mm; errors of the "
      "measurement make {:.2f} mm. ",
      fmt::join(clauses, "; besides, "), heights_words(diagnosis), gap.after_rms_mm, gap.before_rms_mm,
      gap.noise_floor_mm);
}

/// "foam from surface tilt"
std::string pair_words(const NextMeasurement& next) {
  return fmt::format("{} from {}", effects_words(next.separates[0]), effects_words(next.separates[1]));
}

std::string next_sentences(const std::vector<NextMeasurement>& all) {
  constexpr std::size_t kMostOpen = 3;  // pairs, likeliest first
  std::map<std::string, std::vector<std::string>> settled;
  std::vector<std::string> order, open, unsettled;
  for (const NextMeasurement& next : all) {
    if (!next.settles()) {
      open.push_back(pair_words(next));
      if (open.size() > kMostOpen) continue;
      for (const std::vector<std::string>& set : next.separates)
        for (const std::string& name : set)
          if (std::find(unsettled.begin(), unsettled.end(), name) == unsettled.end()) unsettled.push_back(name);
      continue;
    }
    const std::string measurement = fmt::format("{} ({:.0f} min)", next.measurement, next.cost);
    if (settled[measurement].empty()) order.push_back(measurement);
    settled[measurement].push_back(fmt::format("{} ({:.1f} σ)", pair_words(next), next.sigma));
  }
  std::string text;
  for (const std::string& measurement : order)
    text += fmt::format("Measuring {} would tell {}. ", measurement, joined(settled[measurement], "and"));
  if (open.empty()) return text;
  const std::size_t more = open.size() > kMostOpen ? open.size() - kMostOpen : 0;
  open.resize(open.size() - more);
  if (more > 0) open.push_back(fmt::format("{} more pairs", more));
  text += fmt::format("No measurement that was tried in simulation tells {}. ", joined(open, "or"));
  for (const std::string& name : unsettled)
    if (const Effect* effect = find_effect(effect_name(name).id))
      text += fmt::format("A check for {}: {}. ", effect_words(name), effect->discriminated_by);
  return text;
}

/// "foam, cup bottom height or fill offset (98 %)": an explanation and what cannot be told from it.
std::string rival_words(const Explanation& explanation) {
  constexpr std::size_t kMost = 3;
  if (explanation.is_too_small)
    return fmt::format("something too small to show ({:.0f} %)", 100 * explanation.probability);
  std::vector<std::string> alike{effects_words(explanation.effects)};
  for (const std::vector<std::string>& other : explanation.alternatives)
    if (alike.size() < kMost) alike.push_back(effects_words(other));
  const std::size_t more = 1 + explanation.alternatives.size() - alike.size();
  return fmt::format("{}{} ({:.0f} %)", joined(alike, "or"), more > 0 ? fmt::format(", or {} like these", more) : "",
                     100 * explanation.probability);
}

std::string ambiguous_sentence(const Diagnosis& diagnosis) {
  constexpr double kWorthNaming = 0.02;
  constexpr std::size_t kMost = 4;
  const std::vector<Explanation>& set = diagnosis.ambiguity_set;
  if (set.size() == 1 && set.front().alternatives.empty())
    return fmt::format("It may well be {}, but that is not sure. ", effects_words(set.front().effects)) +
           next_sentences(diagnosis.next);
  std::vector<std::string> rivals;
  std::size_t others = 0;
  double probability_of_others = 0.0;
  for (const Explanation& explanation : set) {
    if (explanation.probability >= kWorthNaming && rivals.size() < kMost) {
      rivals.push_back(rival_words(explanation));
      continue;
    }
    others += 1 + explanation.alternatives.size();
    probability_of_others += explanation.probability;
  }
  std::string text = fmt::format("These would explain it, likeliest first: {}. ", fmt::join(rivals, "; "));
  if (others > 0)
    text += fmt::format("{} more {} {:.{}f} % together. ", others, others == 1 ? "has" : "have",
                        100 * probability_of_others, probability_of_others < 0.01 ? 1 : 0);
  return text + next_sentences(diagnosis.next);
}

/// "In session 1 the height in the cup is 1.9 mm higher than in the others (16 σ). ": of each session the clearest.
std::string excess_sentences(const std::vector<Excess>& excesses) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> said;
  std::string text;
  for (const Excess& excess : excesses) {
    const std::string what = excess.level + excess.group;
    if (said.size() == kMost || std::find(said.begin(), said.end(), what) != said.end()) continue;
    said.push_back(what);
    const ObservableWords words = observable_words(excess.observable);
    if (excess.level == "trial") {
      text += fmt::format("The {} is {:.2g}{} more than its noise makes ({:.0f} σ): the sensor or the desk trembles. ",
                          words.name, excess.size, words.unit, excess.size / excess.sigma);
      continue;
    }
    if (excess.level == "unit") {
      text += fmt::format(
          "The desk reads {:.2g}{} {} {} than around it ({:.0f} σ), and a device's own bias is smoother: there may be "
          "a smear on the lens, or something on the desk. ",
          std::abs(excess.size), words.unit, excess.size < 0 ? words.less : words.more, excess.part,
          std::abs(excess.size) / excess.sigma);
      continue;
    }
    if (excess.group.empty()) {
      text += fmt::format("From {} to {} the {} scatters by {:.2g}{} (± {:.1g}) more than is stated. ", excess.level,
                          excess.level, words.name, excess.size, words.unit, excess.sigma);
      continue;
    }
    text += fmt::format(
        "In {} {} the {}{}{} is {:.2g}{} {} than in the others ({:.0f} σ), more than {}s should differ. ", excess.level,
        excess.group, words.name, excess.part.empty() ? "" : " ", excess.part, std::abs(excess.size), words.unit,
        excess.size < 0 ? words.less : words.more, std::abs(excess.size) / excess.sigma, excess.level);
  }
  return text;
}

std::string unknown_sentence(const Diagnosis& diagnosis) {
  const UnknownShape& unknown = diagnosis.unknown;
  std::string text = fmt::format("{} is there that no effect in the list explains",
                                 diagnosis.effects.empty() ? "Something" : "Something else");
  if (diagnosis.departures.excess.empty())
    text += fmt::format(" (probability {:.3g})", diagnosis.probability_of_unknown);
  if (!unknown.part.empty())
    return text +
           fmt::format(": in {}, what is seen {} is {:.2g} mm {}, beside the rest of the cup, than the model has it. ",
                       unknown.liquid == "empty" ? "the empty cup" : spaced(unknown.liquid),
                       unknown.part == "middle" ? "in the middle" : unknown.part, std::abs(unknown.higher_mm),
                       unknown.higher_mm < 0.0 ? "lower" : "higher");
  if (!unknown.formula.empty()) text += fmt::format("; it goes as {}", unknown.formula);
  constexpr double kAlike = 0.5;
  if (!unknown.most_similar.empty() && unknown.similarity >= kAlike)
    text +=
        fmt::format(", and is most like {} (cosine {:.2f})", effect_words(unknown.most_similar), unknown.similarity);
  return text + ". ";
}

std::string agreement(const Diagnosis& diagnosis) {
  constexpr double kLikely = 0.5;
  const double sure_percent = 100 * diagnosis.probability_of_none;
  const std::string agree =
      diagnosis.probability_of_none < kLikely
          ? fmt::format(
                "Nothing is sure enough to be named, but that model and measurement agree is only {:.0f} % sure",
                sure_percent)
          : fmt::format("Model and measurement agree within their errors ({:.0f} % sure)", sure_percent);
  return fmt::format("{}: the {} differ by {:.2f} mm, {:.2f} mm are to be expected.", agree, heights_words(diagnosis),
                     diagnosis.gap.train.after_rms_mm, diagnosis.gap.train.noise_floor_mm);
}

/// Where cups are seen, but nothing in them.
std::string what_is_not_compared(const Diagnosis& diagnosis) {
  const bool sees_cups = compares(diagnosis, "log_brightness") || compares(diagnosis, "cup_x_mm");
  if (compares(diagnosis, "height_mm") || !sees_cups) return {};
  return "No height in a cup could be compared: what a liquid does to heights is not seen here.";
}

/// What is too unsure to be called, but likelier than a slip.
std::string what_may_be_besides(const Diagnosis& diagnosis) {
  constexpr double kWorthAWord = 0.2;
  if (diagnosis.probability_of_unknown < kWorthAWord) return {};
  return fmt::format("Something else may be there as well (probability {:.2g}). ", diagnosis.probability_of_unknown);
}

std::string answer_of_physics(const Diagnosis& diagnosis) {
  switch (diagnosis.verdict) {
    case Verdict::none:
      return agreement(diagnosis);
    case Verdict::insufficient:
      return fmt::format("This cannot be told from these measurements: {}.", joined(diagnosis.data.missing, "and"));
    case Verdict::named:
      if (diagnosis.effects.empty()) return agreement(diagnosis);
      return where_sentence(diagnosis) + named_sentence(diagnosis) + what_may_be_besides(diagnosis);
    case Verdict::ambiguous:
      return where_sentence(diagnosis) + ambiguous_sentence(diagnosis);
    case Verdict::unknown:
      return where_sentence(diagnosis) + excess_sentences(diagnosis.departures.excess) + unknown_sentence(diagnosis);
    case Verdict::named_and_unknown:
      return where_sentence(diagnosis) + named_sentence(diagnosis) + excess_sentences(diagnosis.departures.excess) +
             unknown_sentence(diagnosis);
  }
  return {};
}

}  // namespace

std::string capitalised(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string effect_clause(const NamedEffect& named) {
  const EffectName name = effect_name(named.name);
  const Effect* effect = find_effect(name.id);
  if (!effect) return effect_words(named.name);
  const std::string of = name.liquid.empty() ? "" : fmt::format("of {} alone, ", spaced(name.liquid));
  const bool is_less = named.parameters.front().value < effect->parameters.front().nominal;
  if (std::string text(is_less ? effect->less : effect->more); !text.empty()) {
    const std::string size = size_words(named.parameters.front(), effect->parameters.front(), effect->in_percent);
    return of + text.replace(text.find("{}"), 2, size);
  }
  std::string text(effect->sentence.substr(0, effect->sentence.size() - 1));
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  std::vector<std::string> values;
  for (const NamedParameter& parameter : shown_parameters(named)) values.push_back(parameter_words(parameter));
  return fmt::format("{}{}: {}", of, text, joined(values, "and"));
}

std::string heights_words(const Diagnosis& diagnosis) {
  return compares(diagnosis, "height_mm") ? "heights" : "heights of the sensor above the desk";
}

std::string effect_words(const std::string& name) {
  if (name == "unknown") return "something unknown";
  const EffectName effect = effect_name(name);
  return spaced(effect.id) + (effect.liquid.empty() ? "" : " of " + spaced(effect.liquid));
}

std::string effects_words(const std::vector<std::string>& effects) {
  if (effects.empty()) return "nothing";
  std::vector<std::string> words;
  for (const std::string& effect : effects) words.push_back(effect_words(effect));
  return joined(words, "and");
}

std::string place_words(std::string_view stratum) {
  if (std::string third = third_words(stratum); !third.empty()) return third;
  std::vector<std::string> factors;
  while (!stratum.empty() && stratum != "all") {
    const std::size_t comma = stratum.find(", ");
    const std::string_view factor = stratum.substr(0, comma);
    stratum = comma == std::string_view::npos ? "" : stratum.substr(comma + 2);
    const std::size_t equals = factor.find('=');
    if (equals == std::string_view::npos) {
      factors.emplace_back(factor);
      continue;
    }
    const auto [name, unit] = without_unit(factor.substr(0, equals));
    factors.push_back(fmt::format("{} is {}{}", name, spaced(factor.substr(equals + 1)), unit));
  }
  return factors.empty() ? "" : fmt::format("where {}", fmt::join(factors, " and "));
}

std::string stratum_words(const GapLocation& where) {
  const std::string place = place_words(where.stratum);
  return fmt::format("{}{}{}", observable_words(where.observable).name, place.empty() ? "" : " ", place);
}

std::vector<NamedParameter> shown_parameters(const NamedEffect& named) {
  std::vector<NamedParameter> shown = named.parameters;
  const Effect* effect = find_effect(effect_name(named.name).id);
  for (std::size_t i = 0; effect && i < shown.size(); ++i)
    if (const std::string_view inverse = effect->parameters[i].inverse; !inverse.empty() && shown[i].value != 0.0)
      shown[i] = {std::string(inverse), 1.0 / shown[i].value, 1.0 / shown[i].high95, 1.0 / shown[i].low95};
  return shown;
}

std::string parameter_words(const NamedParameter& parameter) {
  const auto [name, unit] = without_unit(parameter.name);
  return fmt::format("{} = {:.3g}{} (95 %: {:.3g} to {:.3g})", name, parameter.value, unit, parameter.low95,
                     parameter.high95);
}

std::string beside_words(const Departures& departures) {
  std::vector<std::string> names;
  for (const GapLocation& where : departures.beside) {
    const std::string name = fmt::format("the {}", observable_words(where.observable).name);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty() && departures.beside_effects.empty()) return {};
  std::string text = names.empty()      ? "Something besides heights and shapes departs"
                     : names.size() > 1 ? joined(names, "and") + " depart"
                                        : names.front() + " departs";
  text = capitalised(std::move(text)) + " from the model. That alone is no gap: heights and shapes decide.";
  if (!departures.beside_effects.empty())
    text += fmt::format(" It may be {}.", effects_words(departures.beside_effects));
  return text;
}

std::string answer(const Diagnosis& diagnosis) {
  std::string text;
  for (const Mistake& mistake : diagnosis.data.mistakes) text += mistake.sentence + " ";
  if (!text.empty()) text += "With that put right: ";
  text += answer_of_physics(diagnosis);
  while (text.ends_with(' ')) text.pop_back();
  const std::string not_compared = what_is_not_compared(diagnosis);
  return not_compared.empty() ? text : text + " " + not_compared;
}

}  // namespace fathom
