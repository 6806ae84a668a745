// How well a share is known from counts, without approximation (Clopper & Pearson 1934).
#pragma once

namespace fathom::blind {

struct ShareInterval {
  double low, high;
};

/// 95 % interval of the share of `hits` in `trials`; 0 to 1 of no trials.
ShareInterval clopper_pearson_95(int hits, int trials);

}  // namespace fathom::blind
