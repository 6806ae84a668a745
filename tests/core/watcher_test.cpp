// Who waits for long work hears of it, and ends it.
#include "core/watcher.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"

namespace fathom {
namespace {

class Recorder : public Watcher {
 public:
  explicit Recorder(std::size_t most) : most_(most) {}

  void hear(const std::string& what, std::size_t done, std::size_t total) override {
    const std::lock_guard lock(mutex_);
    EXPECT_EQ(what, "piece");
    EXPECT_EQ(total, 1000u);
    heard_.push_back(done);
    if (done >= most_) ends_ = true;
  }
  bool ends() const override { return ends_; }

  const std::vector<std::size_t>& heard() const { return heard_; }

 private:
  std::size_t most_;
  std::atomic<bool> ends_ = false;
  std::mutex mutex_;
  std::vector<std::size_t> heard_;
};

void work(std::atomic<int>& pieces) {
  Progress progress("piece", 1000, true);
  parallel_ranges(1000, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) ++pieces, progress.step();
  });
}

TEST(Watcher, HearsOfEveryStepOfALoopsThreads) {
  Recorder recorder(1001);
  std::atomic<int> pieces = 0;
  {
    const WatcherScope scope(&recorder);
    work(pieces);
  }
  ASSERT_EQ(recorder.heard().size(), 1000u);
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_EQ(recorder.heard()[i], i + 1);
  EXPECT_EQ(watcher(), nullptr);
}

TEST(Watcher, EndsTheLoopAtItsNextStep) {
  Recorder recorder(10);
  std::atomic<int> pieces = 0;
  const WatcherScope scope(&recorder);
  EXPECT_THROW(work(pieces), Ended);
  EXPECT_GE(pieces, 10);
  EXPECT_LT(pieces, 900);
}

TEST(Watcher, EndsLoopsThatTellNoProgress) {
  Recorder recorder(0);
  recorder.hear("piece", 0, 1000);
  const WatcherScope scope(&recorder);
  EXPECT_THROW(parallel_ranges(1000, [](int, int) { FAIL(); }), Ended);
}

TEST(ParallelItems, EachComesOnceAndNoneBeginsWithinAnother) {
  std::vector<std::atomic<int>> calls(200);
  std::atomic<int> rows = 0, begun_within_another = 0;
  parallel_items(200, [&](int i) {
    thread_local bool is_busy = false;
    if (is_busy) ++begun_within_another;
    is_busy = true;
    ++calls[static_cast<std::size_t>(i)];
    parallel_ranges(64, [&](int begin, int end) { rows += end - begin; });
    is_busy = false;
  });
  for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
  EXPECT_EQ(begun_within_another, 0);
  EXPECT_EQ(rows, 200 * 64);
}

TEST(ParallelItems, EndsBetweenThem) {
  Recorder recorder(3);
  std::atomic<int> begun = 0;
  const WatcherScope scope(&recorder);
  Progress progress("piece", 1000, true);
  EXPECT_THROW(parallel_items(1000, [&](int) { ++begun, progress.step(); }), Ended);
  EXPECT_LT(begun, 900);
}

TEST(Watcher, IsNotThatOfOtherWork) {
  std::atomic<int> pieces = 0;
  work(pieces);
  EXPECT_EQ(pieces, 1000);
}

}  // namespace
}  // namespace fathom
