// Rows added up.
#pragma once

namespace fathom {

/// sum[i] += scale · row[i] of `count` values; the rows do not overlap.
void add_scaled(const float* row, float scale, float* sum, int count);

}  // namespace fathom
