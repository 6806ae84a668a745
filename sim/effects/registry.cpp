#include "sim/effects/registry.h"

#include "core/error.h"
#include "sim/effects/effects.h"

namespace fathom {

const std::vector<Effect>& effect_registry() {
  static const std::vector<Effect> registry = [] {
    std::vector<Effect> all;
    for (const auto family : {effects::sensor_effects, effects::liquid_effects, effects::cup_effects,
                              effects::light_effects, effects::bookkeeping_effects, effects::processing_effects})
      for (Effect& effect : family()) all.push_back(std::move(effect));
    return all;
  }();
  return registry;
}

std::vector<std::string> effect_ids() {
  std::vector<std::string> ids;
  for (const Effect& effect : effect_registry()) ids.emplace_back(effect.id);
  return ids;
}

const Effect* find_effect(std::string_view id) {
  for (const Effect& effect : effect_registry())
    if (effect.id == id) return &effect;
  return nullptr;
}

}  // namespace fathom
