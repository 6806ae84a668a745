// The posterior: sets of effects, alone or beside something that no list holds, weighed by the data and their priors.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/refit.h"

namespace fathom {

/// Every explanation that was weighed, and the fits of those that were worth one.
struct Posterior {
  std::vector<Option> options;
  std::vector<Refit> fits;  ///< likeliest first, that of no effects among them
};

/// The fit of these effects; null where there is none.
const Refit* find_fit(const std::vector<Refit>& fits, const std::vector<int>& effects);

/// Sets of up to four effects by their sensitivities; the likeliest fitted with the model itself; each fit alone and
/// beside a discrepancy; and what was not worth a fit but is not excluded.
Posterior posterior_of(const Case& c);

/// What the posterior says of all options together.
struct Shares {
  double nothing = 0.0;  ///< probability of the model as it is
  double unknown = 0.0;  ///< that there is a discrepancy, with effects or without
  double effects = 0.0;  ///< that there is an effect, whichever, with a discrepancy or without
};
Shares shares_of(const std::vector<Option>& options);

/// A check failed with that p, and effects do not explain it: evidence for something unknown of at most 1 / (−e p ln p)
/// (Sellke, Bayarri & Berger 2001, Am. Stat. 55, 62), which the discrepancy did not see.
void weigh_failed_check(double p, std::vector<Option>& options);

/// Probability that the effect is there, in whatever liquid: of all options that have it.
double probability_of(int effect, const std::vector<Option>& options, const std::vector<int>& kinds);

}  // namespace fathom
