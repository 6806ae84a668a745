#include "core/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <thread>
#include <vector>

#include "core/standard_streams.h"
#include "core/watcher.h"

namespace fathom {
namespace {

/// Shows the latest progress again from time to time, so that a long wait for the next item is seen to go on.
class ProgressClock {
 public:
  void add(const void* of, std::function<void()> show) {
    const std::lock_guard lock(mutex_);
    shown_.push_back({of, std::move(show)});
    if (shown_.size() == 1) thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void remove(const void* of) {
    std::jthread done;  // is waited for without the lock
    const std::lock_guard lock(mutex_);
    std::erase_if(shown_, [of](const Shown& each) { return each.of == of; });
    if (!shown_.empty()) return;
    done = std::move(thread_);
    done.request_stop();
  }

 private:
  struct Shown {
    const void* of;
    std::function<void()> show;
  };

  void run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    for (auto pause = std::chrono::seconds(2); !stop.stop_requested(); pause = std::chrono::seconds(1)) {
      stopped_.wait_for(lock, stop, pause, [] { return false; });
      if (!stop.stop_requested() && !shown_.empty()) shown_.back().show();
    }
  }

  std::mutex mutex_;
  std::condition_variable_any stopped_;
  std::vector<Shown> shown_;
  std::jthread thread_;
};

ProgressClock& the_clock() {
  static ProgressClock clock;
  return clock;
}

}  // namespace

Progress::Progress(std::string what, std::size_t total, bool quiet)
    : what_(std::move(what)), total_(total), shown_(!quiet && ::isatty(STDERR_FILENO)) {
  if (!shown_) return;
  the_clock().add(this, [this] {
    const std::lock_guard lock(mutex_);
    show();
  });
}

Progress::~Progress() {
  if (!shown_) return;
  the_clock().remove(this);
  clear_progress();
}

void Progress::step() {
  const std::lock_guard lock(mutex_);
  ++done_;
  tell();
}

void Progress::reach(std::size_t done, std::size_t total) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  total_ = total;
  tell();
}

void Progress::tell() const {
  if (Watcher* const who = watcher()) who->hear(what_, done_, total_);
  go_on();
  show();
}

void Progress::show() const {
  if (!shown_) return;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::string text = what_;
  if (total_ > 1) text += fmt::format(" {}/{}", done_, total_);
  if (done_ > 0 && done_ < total_) {
    const double rate = static_cast<double>(done_) / seconds;
    text += fmt::format("  {:.{}f}/s  {:.0f} s left", rate,
                        rate < 0.1    ? 4
                        : rate < 10.0 ? 2
                                      : 0,
                        static_cast<double>(total_ - done_) / rate);
  } else {
    text += fmt::format("  {:.0f} s", seconds);
  }
  say_progress(text);
}

}  // namespace fathom
