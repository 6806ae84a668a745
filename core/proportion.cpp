#include "core/proportion.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace fathom {
namespace {

constexpr double kTail = 0.025;  ///< beyond either end

}  // namespace

// Boost.Math has no Wilson interval; this is its closed form.
Interval wilson_95(int hits, int trials) {
  if (trials <= 0) return {0.0, 1.0};
  const double z = boost::math::quantile(boost::math::complement(boost::math::normal(), kTail));
  const double n = trials, share = hits / n, z2 = z * z;
  const double middle = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = z * std::sqrt(share * (1.0 - share) / n + z2 / (4.0 * n * n)) / (1.0 + z2 / n);
  return {hits == 0 ? 0.0 : middle - half, hits == trials ? 1.0 : middle + half};
}

Interval clopper_pearson_95(int hits, int trials) {
  if (trials <= 0) return {0.0, 1.0};
  using Binomial = boost::math::binomial_distribution<>;
  return {Binomial::find_lower_bound_on_p(trials, hits, kTail), Binomial::find_upper_bound_on_p(trials, hits, kTail)};
}

}  // namespace fathom
