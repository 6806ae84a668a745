// Whether what is seen inside a cup is its bottom, its bottom raised by a clear liquid, or the surface of an opaque
// one, and how deep the liquid is: a test between hypotheses, with probabilities.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/apparent_rise.h"

namespace fathom {

/// The height of what is seen inside in one view.
struct SurfaceReading {
  double height_m;
  double sigma_m;  ///< of the mean, with errors that neighbours share
  LineOfSight sight;
};

/// Where the cup's own bottom is.
struct Bottom {
  double height_m;
  double sigma_m;
};

/// What else tells the kinds of content apart.
struct ContentSigns {
  double opaque = 1.0;                 ///< likelihood of an opaque filling relative to all else
  std::optional<double> brightness{};  ///< of what is seen inside, as an albedo, over that of the wall above it
  std::string words{};                 ///< what was seen; empty when nothing was
};

struct FillSettings {
  double index = 1.33;         ///< of clear liquids one drinks, at 830 nm: water and tea 1.328, …
  double index_sigma = 0.004;  ///< … lemonades up to 1.34
  double fill_min_m = 0.003;   ///< less is a rest in a cup, not a filling
  double liquid_prior = 0.5;   ///< probability of a liquid before anything is seen
  /// Brightness of a bottom below a clear liquid, over the wall's: 0.96² / n² · exp(−2 · absorption · fill) of a dry
  /// bottom's, which has 0.8 to 0.9 of the wall's. Simulated cups with 10 to 30 mm of water: 0.36 to 0.51.
  double clear_brightness = 0.48;
  double clear_absorption_per_m = 3.1;  ///< of water at 830 nm
  double other_brightness = 0.85;       ///< of dry bottoms and opaque fillings
  double clear_spread = 0.22;           ///< standard deviations of their logarithms: bottoms and walls are alike, …
  double other_spread = 0.35;           ///< … drinks and cups are not
  double brightness_ratio_max = 20.0;   ///< of likelihoods: one in twenty is something that nobody thought of
  /// Probability of a liquid from which on there is one. An empty cup passes it when its height reads 2.5 standard
  /// deviations too high, once in 200.
  double liquid_sure = 0.6;
  /// Probability of no liquid from which on there is none; between the two it is unknown. More is asked for, as with
  /// an error of 0.7 mm 10 mm of water rise by no more than 4.3 standard deviations: one such cup in 300 passes it.
  double dry_sure = 0.95;
  double kind_sure = 0.8;  ///< the same of its kind: where nothing else speaks, a clear one is three times as likely
};

struct FillDecision {
  double p_liquid;
  double p_opaque;  ///< if it is a liquid
  struct Level {
    double fill_m;
    double sigma_m;
  };
  Level transparent, opaque;  ///< how deep, if it is that kind
};

/// `fill_max_m`: from the bottom to the rim. All fills between the least and that are taken as equally likely, and so
/// are both kinds. Without readings the signs alone decide, and the levels say nothing.
FillDecision decide_fill(const std::vector<SurfaceReading>& readings, const Bottom& bottom, double fill_max_m,
                         const ContentSigns& signs, const FillSettings& settings);

}  // namespace fathom
