#include "core/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>

namespace fathom {

void occupy_standard_streams() {
  // open() takes the lowest number that is free. Read only, so that writing fails instead of vanishing.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) < 0) return;
}

namespace {

std::mutex stderr_mutex;
bool has_progress_line = false;  ///< whether stderr stands in a line that the next one is to take the place of

void write_to_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void clear_line() {
  if (has_progress_line) write_to_stderr("\r\033[K");
  has_progress_line = false;
}

}  // namespace

void say(std::string_view text) noexcept {
  const std::lock_guard lock(stderr_mutex);
  clear_line();
  write_to_stderr(text);
}

void say_progress(std::string_view text) noexcept {
  const std::lock_guard lock(stderr_mutex);
  clear_line();
  write_to_stderr(text);
  has_progress_line = true;
}

void clear_progress() noexcept {
  const std::lock_guard lock(stderr_mutex);
  clear_line();
}

void print_result(std::string_view text) {
  const std::lock_guard lock(stderr_mutex);
  clear_line();
  fmt::print("{}", text);
}

}  // namespace fathom
