#include "report/effect_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "report/observable_words.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

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

/// "liquid=milk_tea" → "in milk tea", "lateral_mm=-60" → "60 mm to the left".
std::string factor_words(std::string_view factor) {
  const std::size_t equals = factor.find('=');
  if (equals == std::string_view::npos) return std::string(factor);
  const std::string_view key = factor.substr(0, equals), value = factor.substr(equals + 1);
  if (key == "liquid") return value == "empty" ? "in the empty cup" : fmt::format("in {}", spaced(value));
  if (key == "fill_mm") return fmt::format("at a fill of {} mm", value);
  if (key == "distance_mm") return fmt::format("{} mm away", value);
  if (key == "lateral_mm" && value == "0") return "in the middle";
  if (key == "lateral_mm" && value.starts_with('-')) return fmt::format("{} mm to the left", value.substr(1));
  if (key == "lateral_mm") return fmt::format("{} mm to the right", value);
  if (key == "region")
    return value.find(" mm ") != std::string_view::npos ? std::string(value) : fmt::format("in its {} part", value);
  if (key == "session") return fmt::format("in session {}", value);
  const auto [name, unit] = without_unit(key);
  return fmt::format("where {} is {}{}", name, spaced(value), unit);
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
  const int decimals = decimals_of(low, high);
  return fmt::format("{:.{}f}{} ({:.{}f} to {:.{}f}{})", size, decimals, unit, low, decimals, high, decimals, unit);
}

std::vector<std::string> words_of(const std::vector<std::string>& effects) {
  std::vector<std::string> words;
  for (const std::string& effect : effects) words.push_back(effect_words(effect));
  return words;
}

}  // namespace

int decimals_of(double low95, double high95) {
  constexpr int kMost = 6;
  const double half = 0.5 * std::abs(high95 - low95);
  return half > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half))), 0, kMost) : 2;
}

std::string joined(const std::vector<std::string>& words, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? fmt::format(" {} ", last) : ", ") + words[i];
  return text;
}

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
  return of + text + (values.empty() ? "" : ": " + joined(values, "and"));
}

std::string effect_words(const std::string& name) {
  if (name == "unknown") return "something unknown";
  const EffectName effect = effect_name(name);
  return spaced(effect.id) + (effect.liquid.empty() ? "" : " of " + spaced(effect.liquid));
}

std::string effect_list(const std::vector<std::string>& effects, std::string_view last) {
  return joined(words_of(effects), last);
}

std::string effects_words(const std::vector<std::string>& effects) {
  if (effects.empty()) return "no effect";
  return fmt::format("{}", fmt::join(words_of(effects), " + "));
}

std::string place_words(std::string_view stratum) {
  if (std::string third = third_words(stratum); !third.empty()) return third;
  std::vector<std::string> factors;
  while (!stratum.empty() && stratum != "all") {
    const std::size_t comma = stratum.find(", ");
    const std::string_view factor = stratum.substr(0, comma);
    stratum = comma == std::string_view::npos ? "" : stratum.substr(comma + 2);
    factors.push_back(factor_words(factor));
  }
  return fmt::format("{}", fmt::join(factors, ", "));
}

std::string stratum_words(const GapLocation& where) {
  const std::string place = place_words(where.stratum);
  return fmt::format("{}{}{}", observable_words(where.observable).name, place.empty() ? "" : ", ", place);
}

std::vector<NamedParameter> shown_parameters(const NamedEffect& named) {
  const Effect* effect = find_effect(effect_name(named.name).id);
  if (!effect) return named.parameters;
  std::vector<NamedParameter> shown;
  for (std::size_t i = 0; i < named.parameters.size(); ++i) {
    const NamedParameter& own = named.parameters[i];
    const EffectParameter& parameter = effect->parameters[i];
    if (parameter.is_switch() && own.value > 0.0) continue;  // that it is on, the effect's sentence says
    if (parameter.inverse.empty() || own.low95 <= 0.0)
      shown.push_back(own);
    else
      shown.push_back({std::string(parameter.inverse), 1.0 / own.value, 1.0 / own.high95, 1.0 / own.low95});
  }
  return shown;
}

std::string parameter_name(std::string_view parameter) { return without_unit(parameter).first; }

std::string_view parameter_unit(std::string_view parameter) { return without_unit(parameter).second; }

std::string parameter_words(const NamedParameter& parameter) {
  const auto [name, unit] = without_unit(parameter.name);
  const int decimals = decimals_of(parameter.low95, parameter.high95);
  return fmt::format("{} = {:.{}f}{} (95 %: {:.{}f} to {:.{}f})", name, parameter.value, decimals, unit,
                     parameter.low95, decimals, parameter.high95, decimals);
}

}  // namespace fathom
