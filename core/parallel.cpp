#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "core/watcher.h"

#ifdef FATHOM_TELL_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace fathom {
namespace {

#ifdef FATHOM_TELL_THREAD_SANITIZER
/// The sanitizer cannot look into Debian's TBB: it is told what that promises, that pieces of a loop come after what
/// was before the loop, and before what is after it; not that one piece comes after another.
class Order {
 public:
  Order() { __tsan_release(&begun_); }
  ~Order() { __tsan_acquire(&ended_); }
  void begin_piece() { __tsan_acquire(&begun_); }
  void end_piece() { __tsan_release(&ended_); }

 private:
  char begun_ = 0, ended_ = 0;
};
#else
struct Order {
  void begin_piece() {}
  void end_piece() {}
};
#endif

/// Calls `piece(begin, end)` for ranges; one of `grain` turns or fewer is not divided further.
template <class Piece, class Partitioner>
void share(int count, int grain, const Piece& piece, const Partitioner& partitioner) {
  [[maybe_unused]] Order order;
  Watcher* const who = watcher();
  const auto run = [&](const tbb::blocked_range<int>& range) {
    order.begin_piece();
    const WatcherScope scope(who);
    go_on();
    piece(range.begin(), range.end());
    order.end_piece();
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, count, grain), run, partitioner);
}

}  // namespace

void parallel_ranges(int count, const std::function<void(int, int)>& body) {
  share(count, 4, body, tbb::auto_partitioner());
}

void parallel_items(int count, const std::function<void(int)>& body) {
  const auto one = [&](int i, int) {
    // A thread that waits for the rest of a loop within its item begins no other item meanwhile.
    tbb::this_task_arena::isolate([&] { body(i); });
  };
  share(count, 1, one, tbb::simple_partitioner());
}

int thread_count() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace fathom
