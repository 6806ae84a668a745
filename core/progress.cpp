#include "core/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include "core/standard_streams.h"
#include "core/watcher.h"

namespace fathom {

Progress::Progress(std::string what, std::size_t total, bool quiet)
    : what_(std::move(what)), total_(total), shown_(!quiet && ::isatty(STDERR_FILENO)) {}

Progress::~Progress() {
  if (shown_ && done_ > 0) say("\r\033[K");
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
  const double rate = static_cast<double>(done_) / seconds;
  say(fmt::format("\r\033[K{} {}/{}  {:.2g}/s  {:.0f} s left", what_, done_, total_, rate,
                  static_cast<double>(total_ - done_) / rate));
}

}  // namespace fathom
