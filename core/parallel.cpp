#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace fathom {

void parallel_ranges(int count, const std::function<void(int, int)>& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, count, 4),
                    [&](const tbb::blocked_range<int>& range) { body(range.begin(), range.end()); });
}

int thread_count() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace fathom
