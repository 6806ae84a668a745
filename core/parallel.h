// Loops on all threads that main allows (tbb::global_control). Each turn writes only its own data.
#pragma once

#include <functional>

namespace fathom {

/// Calls `body(begin, end)` for disjoint ranges that cover 0 … count-1, as rows of an image. Throws Ended between them
/// where the work's watcher ends it (core/watcher.h).
void parallel_ranges(int count, const std::function<void(int begin, int end)>& body);

/// The same row by row: for loops that need no memory of their own for a range.
template <class Body>
void parallel_rows(int count, const Body& body) {
  parallel_ranges(count, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) body(row);
  });
}

/// Calls `body(i)` for each i of 0 … count-1, where one call is much work: a frame, a file. Threads take them one by
/// one, so that none is left with several when the others are done. Loops within a call are shared with idle threads.
void parallel_items(int count, const std::function<void(int i)>& body);

/// The number of threads the loops above use.
int thread_count();

}  // namespace fathom
