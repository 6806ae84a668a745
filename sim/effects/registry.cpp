#include "sim/effects/registry.h"

#include "core/error.h"
#include "sim/effects/effects.h"

namespace fathom {

const std::vector<Effect>& effect_registry() {
  static const std::vector<Effect> registry = [] {
    struct Family {
      std::string_view name;
      std::vector<Effect> (*effects)();
    };
    constexpr Family kFamilies[] = {
        {"sensor", effects::sensor_effects},        {"liquid", effects::liquid_effects},
        {"surface", effects::surface_effects},      {"cup", effects::cup_effects},
        {"light", effects::light_effects},          {"book-keeping", effects::bookkeeping_effects},
        {"processing", effects::processing_effects}};
    std::vector<Effect> all;
    for (const Family& family : kFamilies)
      for (Effect& effect : family.effects()) {
        effect.family = family.name;
        all.push_back(std::move(effect));
      }
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
