// What can be hidden in a set: the effects of the registry's first list as changes of the physical world, and some that
// no registry knows.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "blind/pack_plan.h"
#include "blind/world.h"

namespace fathom::blind {

struct Hidden {
  std::string_view name;
  std::string_view parameter;  ///< whose truth is written down, with its unit
  double nominal;              ///< value of that parameter at which the effect is absent
  double typical;              ///< departure from nominal that is easily seen
  double least, most;          ///< departures that can be built; least < 0 < most where both signs can
  bool registered;             ///< false: has to be called unknown
  void (*apply)(World& world, const Placement& placement, double departure);
};

std::span<const Hidden> hidden_effects();
const Hidden& hidden_effect(std::string_view name);

/// Where an effect shows: in how far repeats scatter or in the device's steps alone, or in means of readings.
bool shows_in_spread(const Hidden& effect);
bool shows_in_steps(const Hidden& effect);
bool shows_in_means(const Hidden& effect);
bool shows_by_session(const Hidden& effect);  ///< sessions differ in what it does
bool shows_over_time(const Hidden& effect);   ///< what it does goes by Placement's times
/// A bend of the whole image, the same in all frames.
bool passes_for_the_unit(const Hidden& effect);
/// Whether placements of one liquid, fill and place differ in what it does.
bool differs_by_placement(const Hidden& effect);

/// An effect at work in a set.
struct Active {
  const Hidden* effect;
  double departure;
};

void apply_all(World& world, const Placement& placement, std::span<const Active> effects);

}  // namespace fathom::blind
