// Names of effects: "id", or "id@liquid" for the effect in one liquid only.
#pragma once

#include <string>
#include <string_view>

namespace fathom {

struct EffectName {
  std::string id, liquid;  ///< no liquid: in all
};

inline EffectName effect_name(std::string_view name) {
  const std::size_t at = name.find('@');
  if (at == std::string_view::npos) return {std::string(name), ""};
  return {std::string(name.substr(0, at)), std::string(name.substr(at + 1))};
}

inline std::string name_of(const EffectName& effect) {
  return effect.liquid.empty() ? effect.id : effect.id + "@" + effect.liquid;
}

}  // namespace fathom
