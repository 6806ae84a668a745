// A share of trials as rows: how many of how many, and what that says.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/proportion.h"
#include "core/rows.h"

namespace fathom {

/// NAME "hits/trials", NAME_low and NAME_high, Wilson's 95 % interval.
inline void add_share(const std::string& name, int hits, int trials, std::vector<Row>& rows) {
  const Interval interval = wilson_95(hits, trials);
  rows.push_back({name, fmt::format("{}/{}", hits, trials)});
  rows.push_back({name + "_low", interval.low});
  rows.push_back({name + "_high", interval.high});
}

}  // namespace fathom
