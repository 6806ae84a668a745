#include "blind/clopper_pearson.h"

#include <boost/math/special_functions/beta.hpp>

namespace fathom::blind {

ShareInterval clopper_pearson_95(int hits, int trials) {
  if (trials <= 0) return {0.0, 1.0};
  constexpr double kTail = 0.025;
  const double k = hits, n = trials;
  return {hits == 0 ? 0.0 : boost::math::ibeta_inv(k, n - k + 1.0, kTail),
          hits == trials ? 1.0 : boost::math::ibeta_inv(k + 1.0, n - k, 1.0 - kTail)};
}

}  // namespace fathom::blind
