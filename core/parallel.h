// Loops over rows on all threads that main allows (tbb::global_control). Each row writes only its own data.
#pragma once

#include <functional>

namespace fathom {

/// Calls `body(begin, end)` for disjoint ranges that cover 0 … count-1. Throws Ended between them where the work's
/// watcher ends it (core/watcher.h).
void parallel_ranges(int count, const std::function<void(int begin, int end)>& body);

/// The number of threads the loops above use.
int thread_count();

}  // namespace fathom
