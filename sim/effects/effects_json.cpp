#include "sim/effects/effects_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/json.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

const Effect& effect_named_in(const JsonReader& json) {
  const std::string name = json.text("name");
  const Effect* effect = find_effect(name);
  if (!effect) json.fail_at("name", unknown_name("effect", name, effect_ids()));
  return *effect;
}

void require_known_keys(const JsonReader& json, const Effect& effect) {
  std::vector<std::string> keys;
  for (const EffectParameter& parameter : effect.parameters) {
    keys.emplace_back(parameter.name);
    if (!parameter.inverse.empty()) keys.emplace_back(parameter.inverse);
  }
  if (effect.of_liquids) keys.emplace_back("liquid");
  for (const auto& [key, value] : json.value().items())
    if (key != "name" && std::find(keys.begin(), keys.end(), key) == keys.end())
      json.fail_at(key, unknown_name(fmt::format("parameter of {}", effect.id), key, keys));
}

double value_of(const JsonReader& json, const EffectParameter& parameter) {
  if (parameter.inverse.empty() || !json.has(parameter.inverse))
    return json.number_or(parameter.name, parameter.nominal, {parameter.lower, parameter.upper});
  if (json.has(parameter.name)) json.fail_at(parameter.inverse, fmt::format("cannot stand beside {}", parameter.name));
  return 1.0 / json.number(parameter.inverse,
                           {1.0 / parameter.upper, parameter.lower > 0.0 ? 1.0 / parameter.lower : Range{}.high});
}

void switch_on(const JsonReader& json, Setup& setup) {
  const Effect& effect = effect_named_in(json);
  require_known_keys(json, effect);
  std::vector<double> values;
  for (const EffectParameter& parameter : effect.parameters) values.push_back(value_of(json, parameter));
  const std::string liquid = json.text_or("liquid", "");
  effect.apply(setup, {values, liquid});
}

}  // namespace

Setup with_effects(Setup setup) {
  const Json list = std::exchange(setup.effects, SharedJson::array());
  Json switched_on = setup.switched_on;
  for (std::size_t i = 0; i < list.size(); ++i) {
    switch_on(JsonReader(list[i], setup.file, fmt::format("/effects/{}", i)), setup);
    switched_on.push_back(list[i]);
  }
  setup.switched_on = std::move(switched_on);
  return setup;
}

Json effects_of_model(const std::filesystem::path& model) {
  const Json value = read_json(model);
  const JsonReader json(value, model.string());
  if (!value.is_object() || !value.contains("effects")) json.fail("must be an object with the list effects");
  json.at("effects").items();
  return value["effects"];
}

Setup with_effects_of_model(Setup setup, const std::filesystem::path& model) {
  setup = with_effects(std::move(setup));
  setup.effects = effects_of_model(model);
  const std::string scene = std::exchange(setup.file, model.string());
  setup = with_effects(std::move(setup));
  setup.file = scene;
  return setup;
}

}  // namespace fathom
