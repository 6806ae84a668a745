#include "report/diagnosis_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/statistics/decision_settings.h"
#include "diagnosis/statistics/evidence.h"
#include "report/observable_words.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

/// Sentences end with a blank, for the next one.
std::string without_last_blank(std::string text) {
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

constexpr double kLikely = 0.5;  // that nothing is missing

/// Whether values that were written down are far from what fits best, though within their errors.
bool is_moved(const Gap& gap) {
  constexpr double kFar = 2.0;  // errors
  return gap.train.before_rms_mm > kFar * std::max(gap.train.noise_floor_mm, gap.train.after_rms_mm) &&
         !gap.taken_up.empty();
}

/// Whether what is left is larger than errors usually make it, though too few of these are independent to be sure.
bool is_wide(const GapSize& gap) {
  constexpr double kWide = 1.5;  // times the errors
  return gap.after_rms_mm > kWide * gap.noise_floor_mm;
}

bool compares(const Diagnosis& diagnosis, std::string_view observable) {
  return std::any_of(diagnosis.budget.begin(), diagnosis.budget.end(),
                     [&](const ConditionBudget& line) { return line.observable == observable; });
}

/// Whether a departure of the desk says the same as an effect that was named.
bool says_effect(const GapLocation& where, const Diagnosis& diagnosis) {
  constexpr std::pair<std::string_view, std::string_view> kSame[] = {
      {"desk_height_mm", "sensor_height"}, {"desk_pitch_deg", "sensor_pitch"}, {"desk_roll_deg", "sensor_roll"}};
  return std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(), [&](const NamedEffect& effect) {
    return std::find(std::begin(kSame), std::end(kSame),
                     std::pair<std::string_view, std::string_view>(where.observable, effect.name)) != std::end(kSame);
  });
}

/// "In milk tea, the height in the cup is 1.4 mm lower than the model has it.": where the gap is largest.
std::string where_sentence(const Diagnosis& diagnosis) {
  if (diagnosis.departures.where.empty()) return {};
  const GapLocation& where = diagnosis.departures.where.front();
  // Of a shape that nothing explains, unknown_sentence() says where it is.
  if (where.observable == "content_shape_mm" && !diagnosis.unknown.part.empty()) return {};
  if (says_effect(where, diagnosis)) return {};
  // A surface that leans is higher in one place and lower in another.
  constexpr double kHasMean = 2.0;  // σ
  if (std::abs(where.mean) < kHasMean * where.sigma && std::abs(where.departure) < kHasMean * where.sigma) return {};
  const std::vector<Excess>& excess = diagnosis.departures.excess;  // excess_sentences() says those
  if (!excess.empty() && excess.front().level == "session" && excess.front().observable == where.observable &&
      where.stratum == fmt::format("session={}", excess.front().group))
    return {};
  const ObservableWords words = observable_words(where.observable);
  const std::string place = place_words(where.stratum);
  // What differs from place to place may have a mean of nothing where it differs most.
  const bool is_of_itself = where.departure * where.mean > 0.5 * where.mean * where.mean;
  const double size = is_of_itself ? where.departure : where.mean;
  return capitalised(fmt::format("{}{}the {} is {:.2g}{} {} than the model has it. ", place.empty() ? "" : place + ", ",
                                 is_of_itself ? "" : "compared with the rest, ", words.name, std::abs(size), words.unit,
                                 size < 0 ? words.less : words.more));
}

std::string named_sentence(const Diagnosis& diagnosis) {
  std::vector<std::string> clauses;
  for (const NamedEffect& effect : diagnosis.effects) clauses.push_back(effect_clause(effect));
  const bool is_one = clauses.size() == 1;
  for (std::size_t i = 0; !is_one && i < clauses.size(); ++i) clauses[i] = fmt::format("({}) {}", i + 1, clauses[i]);
  const GapSize& gap = diagnosis.gap.train;
  return fmt::format(
      "Best explanation: {}. With {} in the model the {} differ by {:.2f} mm (rms) instead of {:.2f} mm; errors alone "
      "make {:.2f} mm. ",
      joined(clauses, "and"), is_one ? "that" : "these", heights_words(diagnosis), gap.after_rms_mm, gap.before_rms_mm,
      gap.noise_floor_mm);
}

/// What is named may be in other liquids.
std::string liquids_left_open(const Diagnosis& diagnosis) {
  constexpr std::size_t kMost = 3;
  if (diagnosis.ambiguity_set.empty() || !diagnosis.ambiguity_set.front().is_liquid_open) return {};
  std::vector<std::string> others;
  for (std::vector<std::string> other : diagnosis.ambiguity_set.front().alternatives) {
    std::erase(other, "unknown");
    if (others.size() < kMost) others.push_back(effects_words(other));
  }
  return fmt::format("It is not sure in which liquids: it may also be {}. ", joined(others, "or"));
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
      text += fmt::format("Check {} by {}. ", effect_words(name), effect->discriminated_by);
  return text;
}

/// "foam, cup bottom height or fill offset (98 %)": an explanation and what cannot be told from it.
std::string rival_words(const Explanation& explanation, bool are_others_left) {
  constexpr std::size_t kMost = 3;
  if (explanation.is_too_small)
    return fmt::format("something too small to show ({})", percent_words(explanation.probability, are_others_left));
  std::vector<std::string> alike{effects_words(explanation.effects)};
  for (const std::vector<std::string>& other : explanation.alternatives)
    if (alike.size() < kMost) alike.push_back(effects_words(other));
  const std::size_t more = 1 + explanation.alternatives.size() - alike.size();
  return fmt::format("{}{} ({})", joined(alike, "or"), more > 0 ? fmt::format(", or {} like these", more) : "",
                     percent_words(explanation.probability, are_others_left));
}

std::string ambiguous_sentence(const Diagnosis& diagnosis, bool says_where) {
  constexpr double kWorthNaming = 0.02;
  constexpr std::size_t kMost = 4;
  const std::vector<Explanation>& set = diagnosis.ambiguity_set;
  if (set.size() == 1 && set.front().alternatives.empty())
    return fmt::format("It may well be {}, but that is not sure. ", effects_words(set.front().effects));
  std::vector<std::string> rivals;
  std::size_t others = 0;
  double probability_of_others = 0.0;
  for (const Explanation& explanation : set) {
    if (explanation.probability >= kWorthNaming && rivals.size() < kMost) {
      rivals.push_back(rival_words(explanation, set.size() > 1));
      continue;
    }
    others += 1 + explanation.alternatives.size();
    probability_of_others += explanation.probability;
  }
  std::string text =
      fmt::format("{}, likeliest first: {}. ", says_where ? "These would explain it" : "These explanations are left",
                  fmt::join(rivals, "; "));
  if (others > 0)
    text += fmt::format("{} {:.{}f} %. ", others == 1 ? "One more has" : fmt::format("{} more together have", others),
                        100 * probability_of_others, probability_of_others < 0.01 ? 1 : 0);
  return text;
}

/// "In session 1 the height in the cup is 1.9 mm higher than in other sessions (16 σ). ": of each session the clearest.
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
      text += fmt::format(
          "The {} is {:.2g}{} more than its noise makes ({:.0f} σ): the sensor or the desk trembles, or images are "
          "sheared. ",
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
        "In {} {} the {}{}{} is {:.2g}{} {} than in other {}s ({:.0f} σ), more than {}s should differ. ", excess.level,
        excess.group, words.name, excess.part.empty() ? "" : " ", excess.part, std::abs(excess.size), words.unit,
        excess.size < 0 ? words.less : words.more, excess.level, std::abs(excess.size) / excess.sigma, excess.level);
  }
  return text;
}

std::string unknown_sentence(const Diagnosis& diagnosis) {
  const UnknownShape& unknown = diagnosis.unknown;
  std::string text = fmt::format("{} is there that no effect in the list explains",
                                 diagnosis.effects.empty() ? "Something" : "Something else");
  if (diagnosis.departures.excess.empty())
    text += fmt::format(" (probability {})", percent_words(diagnosis.probability_of_unknown, true));
  if (!unknown.part.empty())
    return text +
           fmt::format(": in {}, what is seen {} is {:.2g} mm {}, beside the rest of the cup, than the model has it. ",
                       unknown.liquid == "empty" ? "the empty cup" : spaced(unknown.liquid),
                       unknown.part == "middle" ? "in the middle" : unknown.part, std::abs(unknown.higher_mm),
                       unknown.higher_mm < 0.0 ? "lower" : "higher");
  constexpr double kAlike = 0.8;  // cosine
  if (!unknown.most_similar.empty() && unknown.similarity >= kAlike)
    text += fmt::format("; it looks most like {}", effect_words(unknown.most_similar));
  return text + ". ";
}

/// What is too unsure to be called, but likelier than a slip.
std::string what_may_be_besides(const Diagnosis& diagnosis) {
  constexpr double kWorthAWord = 0.2;
  if (diagnosis.probability_of_unknown < kWorthAWord) return {};
  return fmt::format("Something {} may be there (probability {}). ",
                     diagnosis.effects.empty() ? "that is not in the list" : "else",
                     percent_words(diagnosis.probability_of_unknown, true));
}

/// Which stated values had to be moved for the rest to be errors; nothing where they hardly matter.
std::string what_was_moved(const Gap& gap) {
  constexpr std::size_t kMost = 3;
  if (!is_moved(gap)) return {};
  std::vector<std::string> inputs;
  for (std::size_t i = 0; i < std::min(kMost, gap.taken_up.size()); ++i)
    inputs.push_back(fmt::format("{} (which makes {:.2f} mm)", gap.taken_up[i].input, gap.taken_up[i].rms_mm));
  return fmt::format(
      " With all values as they were written down they would differ by {:.2f} mm. Uncertain values were moved to where "
      "they are likeliest, most of all {}.",
      gap.train.before_rms_mm, joined(inputs, "and"));
}

/// The likeliest explanation, unless it is that something unknown is there: what_may_be_besides() says that.
std::string likeliest_words(const std::vector<Explanation>& set) {
  const auto has_effects = [](const Explanation& one) { return !one.effects.empty() && !one.is_too_small; };
  const auto first = std::ranges::find_if(set, has_effects);
  return first == set.end() || first->effects == std::vector<std::string>{"unknown"}
             ? ""
             : fmt::format("The likeliest is {}. ", rival_words(*first, true));
}

std::string agreement(const Diagnosis& diagnosis) {
  const std::string sure = percent_words(diagnosis.probability_of_none);
  const std::string agree =
      diagnosis.probability_of_none < kLikely
          ? fmt::format(
                "No effect is sure enough to be named, but the probability that nothing is missing is only {}. ",
                sure) +
                likeliest_words(diagnosis.ambiguity_set) + what_may_be_besides(diagnosis)
          : fmt::format("Model and measurement agree within their errors (probability that nothing is missing: {}). ",
                        sure);
  const GapSize& gap = diagnosis.gap.train;
  return agree +
         fmt::format("The {} differ by {:.2f} mm (rms), where errors alone make {:.2f} mm.{}", heights_words(diagnosis),
                     gap.after_rms_mm, gap.noise_floor_mm,
                     is_wide(gap) ? " Heights of one session, pour or placement share an error: a few may be large by "
                                    "chance, or something differs there."
                                  : "") +
         what_was_moved(diagnosis.gap);
}

/// Where cups are seen, but nothing in them.
std::string what_is_not_compared(const Diagnosis& diagnosis) {
  const bool sees_cups = compares(diagnosis, "log_brightness") || compares(diagnosis, "cup_x_mm");
  if (compares(diagnosis, "height_mm") || !sees_cups) return {};
  return "No height in a cup could be compared: what a liquid does to heights is not seen here.";
}

/// Where to look for the cause of something that no effect in the list explains.
std::string look_words(const Departures& departures) {
  const std::string level = departures.excess.empty() ? "" : departures.excess.front().level;
  if (level == "session")
    return "Look at what changed between the sessions: the sensor's place and calibration, the cup, the ruler. Then "
           "measure a condition of another session again.";
  if (level == "trial") return "See that the sensor and the desk stand still, and measure again.";
  if (level == "unit") return "Clean the lens, clear the desk, and take views of the bare desk again.";
  if (!level.empty())
    return fmt::format(
        "Pour and place with more care, or state in rig.json by how much a {} may be off (fill_sigma_mm, "
        "placement_sigma_mm).",
        level);
  return "Look at the cup and the sensor where measurement and model differ. If you find the cause, an effect of your "
         "own can be added to the list in one file.";
}

std::string finding_of_physics(const Diagnosis& diagnosis) {
  const std::string where = where_sentence(diagnosis);
  switch (diagnosis.verdict) {
    case Verdict::none:
      return agreement(diagnosis);
    case Verdict::insufficient:
      return fmt::format("No answer can be given from these measurements: {}.", joined(diagnosis.data.missing, "and"));
    case Verdict::named:
      if (diagnosis.effects.empty()) return agreement(diagnosis);
      return where + named_sentence(diagnosis) + liquids_left_open(diagnosis) + what_may_be_besides(diagnosis);
    case Verdict::ambiguous:
      return where + ambiguous_sentence(diagnosis, !where.empty());
    case Verdict::unknown:
      return where + excess_sentences(diagnosis.departures.excess) + unknown_sentence(diagnosis);
    case Verdict::named_and_unknown:
      return where + named_sentence(diagnosis) + liquids_left_open(diagnosis) +
             excess_sentences(diagnosis.departures.excess) + unknown_sentence(diagnosis);
  }
  return {};
}

}  // namespace

std::string percent_words(double probability, bool are_others_left) {
  if (probability >= 0.9995) return are_others_left ? "over 99.9 %" : "100 %";
  return fmt::format("{:.{}f} %", 100 * probability, are_others_left && probability >= 0.995 ? 1 : 0);
}

std::string heights_words(const Diagnosis& diagnosis) {
  return compares(diagnosis, "height_mm") ? "heights" : "heights of the sensor above the desk";
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

std::string finding(const Diagnosis& diagnosis) {
  std::string text;
  for (const Mistake& mistake : diagnosis.data.mistakes) text += mistake.sentence + " ";
  if (!text.empty()) text += "With that put right: ";
  text = without_last_blank(text + finding_of_physics(diagnosis));
  const std::string not_compared = what_is_not_compared(diagnosis);
  return not_compared.empty() ? text : text + " " + not_compared;
}

std::vector<std::string> advice(const Diagnosis& diagnosis) {
  std::vector<std::string> steps;
  const auto add = [&](std::string step) {
    if (step = without_last_blank(std::move(step)); !step.empty()) steps.push_back(std::move(step));
  };
  const bool is_unknown = diagnosis.verdict == Verdict::unknown || diagnosis.verdict == Verdict::named_and_unknown;
  if (is_unknown) add(look_words(diagnosis.departures));
  for (const NamedEffect& named : diagnosis.effects)
    if (const Effect* effect = find_effect(effect_name(named.name).id))
      add(fmt::format("Check {} by {}.", effect_words(named.name), effect->discriminated_by));
  if (!diagnosis.effects.empty())
    add("Where a check confirms an effect, correct what was written down of the rig or the shots, and diagnose again. "
        "Where nothing can be corrected, --model model.json takes the effect into the model.");
  if (diagnosis.verdict == Verdict::ambiguous) {
    add(next_sentences(diagnosis.next));
    const bool has_plan = std::any_of(diagnosis.next.begin(), diagnosis.next.end(),
                                      [](const NextMeasurement& next) { return next.settles(); });
    if (has_plan) add("next_1.json holds the plan of the first of these measurements.");
  }
  if (diagnosis.verdict == Verdict::none && diagnosis.data.mistakes.empty()) {
    if (is_moved(diagnosis.gap))
      add(fmt::format("To be surer, find out more exactly what was moved most: {}.",
                      diagnosis.gap.taken_up.front().input));
    if (is_wide(diagnosis.gap.train))
      add("Look in heights.png which heights differ together, and measure these again.");
    if (diagnosis.probability_of_none < kLikely) add(next_sentences(diagnosis.next));
    if (steps.empty()) add("Nothing: no further measurement is needed.");
  }
  return steps;
}

std::string answer(const Diagnosis& diagnosis) {
  std::string text = finding(diagnosis);
  if (diagnosis.verdict == Verdict::ambiguous) text += fmt::format(" {}", next_sentences(diagnosis.next));
  return without_last_blank(std::move(text));
}

}  // namespace fathom
