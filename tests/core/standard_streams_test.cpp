#include "core/standard_streams.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fathom {
namespace {

// The first file that is opened would be stdin, the second stdout, and would hold what is printed.
TEST(StandardStreams, ThatAreClosedAreNotTakenByFiles) {
  const ::pid_t child = ::fork();
  if (child == 0) {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(stream);
    occupy_standard_streams();
    const bool apart = ::open("/dev/null", O_WRONLY) > STDERR_FILENO;
    say("nobody is told");
    ::_exit(apart && ::write(STDOUT_FILENO, "x", 1) < 0 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace fathom
