// What the generator reads under every condition of the designs, in the world as it is believed and with one thing
// changed: seen once for all sets of a pack.
#pragma once

#include <array>
#include <compare>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "blind/hidden.h"
#include "blind/observe.h"
#include "blind/pack_plan.h"
#include "blind/unit.h"

namespace fathom::blind {

/// Placements of one condition read alike, unless something differs from one placement to the next.
struct Condition {
  std::string liquid;
  double fill, distance, lateral;
  auto operator<=>(const Condition&) const = default;
};
Condition condition_of(const Placement& placement);

/// Readings with the cup a little elsewhere in each look, where other dots fall into other windows. They are the same
/// places, dots and grains for every change.
inline constexpr int kLooks = 4;
using View = std::array<Readings, kLooks>;
using Change = std::function<void(World&, const Placement&)>;
View view(const Placement& placement, const Change& change);

/// What one draw of an error is shared by.
enum class Shared { by_all, by_pour, by_session, by_placement };

/// An error that every set has, hidden effects or not.
struct Nuisance {
  double sigma;
  void (*add)(World&, double amount);
  Shared shared;
};
const std::vector<Nuisance>& nuisances();
/// By so many σ a nuisance is changed for its view. The larger the change is, the less do the dots count that happen to
/// change windows.
inline constexpr double kNuisanceSigmas = 4.0;

struct ConditionViews {
  View believed{};
  std::array<View, kUnitWaves> unit{};  ///< of each wave of a unit's bias, of kNuisanceSigmas
  std::vector<View> nuisances{};        ///< of kNuisanceSigmas each, in the order of nuisances()
  /// Of each effect at its typical departure, if it shows in means and does the same to all placements of a condition.
  std::map<std::string_view, View> typical{};
  std::map<int, Readings> noise{};  ///< for the number of trials: sigmas
};

using Views = std::map<Condition, ConditionViews>;

/// On all threads.
Views views_of(std::span<const Design> designs);

}  // namespace fathom::blind
