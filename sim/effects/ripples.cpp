#include <cmath>
#include <numbers>

#include "core/rng.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

/// Waves of 15 mm have passed their length in a fifteenth of a second: no two shots see them alike, and what all see in
/// the mean does not go by time.
Ripple wave_at(double time_s, double mean_square_slope) {
  constexpr std::uint64_t kKey = 0x71991e5;
  constexpr double kWavelength = 0.015;  // [m]
  const double amplitude = kWavelength / (2.0 * std::numbers::pi) * std::sqrt(2.0 * mean_square_slope);
  Rng rng(kKey, static_cast<std::uint64_t>(std::llround(1000.0 * time_s)));
  const double azimuth = 2.0 * std::numbers::pi * rng.uniform();
  return {.wavelength = kWavelength,
          .amplitude = amplitude,
          .azimuth = azimuth,
          .phase = 2.0 * std::numbers::pi * rng.uniform()};
}

void apply_ripples(Setup& setup, const EffectSetting& setting) {
  if (setting.values[0] == 0.0) return;
  for_each_filling(setup, setting, [&](Cup&, Filling& filling) {
    filling.form.ripples.push_back(wave_at(setup.circumstances.time_s, setting.values[0]));
  });
}

}  // namespace

Effect ripples() {
  return {
      .id = "ripples",
      .sentence = "Waves of 15 mm run over the liquid's surface, each time from elsewhere.",
      .parameters = {{"mean_square_slope", "of the waves: 0.005 where they are 0.24 mm high", 0.0, 0.005, 0.0, 0.1}},
      .citation =
          "Cox & Munk 1954, Journal of the Optical Society of America 44, 838: what waves do to sight goes "
          "by their mean square slope",
      .confounded = {"refractive_index", "fill_scale"},
      .discriminated_by = "how trials scatter: no two shots see waves alike; trials spread over time: they die out",
      .apply = apply_ripples,
      .of_liquids = true};
}

}  // namespace fathom::effects
