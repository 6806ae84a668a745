#include "core/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace fathom {

void occupy_standard_streams() {
  // open() takes the lowest number that is free. Read only, so that writing fails instead of vanishing.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) < 0) return;
}

void say(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace fathom
