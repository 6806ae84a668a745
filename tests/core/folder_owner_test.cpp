// One folder, one writer: the kernel's lock holds among processes, and a kill gives it up.
#include "core/folder_owner.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "core/files.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// A process of its own that runs `work` and waits to be killed; it says by a pipe that the work is done.
class Child {
 public:
  explicit Child(const std::function<void()>& work) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    process_ = ::fork();
    if (process_ == 0) {
      work();
      static_cast<void>(::write(ends[1], "x", 1) == 1);
      for (;;) ::pause();
    }
    char done;
    EXPECT_EQ(::read(ends[0], &done, 1), 1);
    ::close(ends[0]), ::close(ends[1]);
  }
  ~Child() { kill(); }

  pid_t process() const { return process_; }
  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
};

TEST(FolderOwner, ASecondProcessIsToldWhoWrites) {
  const TemporaryFolder folder;
  const Child first([&] { new FolderOwner(folder / "out"); });
  expect_error([&] { const FolderOwner second(folder / "out"); },
               {(folder / "out").string() + ": is being written by process " + std::to_string(first.process())});
}

TEST(FolderOwner, AKilledOwnerLocksNobodyOut) {
  const TemporaryFolder folder;
  Child first([&] { new FolderOwner(folder / "out"); });
  first.kill();
  const FolderOwner second(folder / "out");
  EXPECT_TRUE(fs::exists(folder / "out"));
}

TEST(FolderOwner, LeavesNothingOfItsOwn) {
  const TemporaryFolder folder;
  { const FolderOwner owner(folder / "new"); }
  EXPECT_FALSE(fs::exists(folder / "new"));  // it made the folder, and nothing was written
  make_directory(folder / "old");
  { const FolderOwner owner(folder / "old"); }
  EXPECT_TRUE(fs::is_directory(folder / "old"));
  EXPECT_TRUE(fs::is_empty(folder / "old"));
  {
    const FolderOwner owner(folder / "written");
    write_text(folder / "written/a.txt", "a");
  }
  EXPECT_EQ(read_text(folder / "written/a.txt"), "a");
}

/// /proc says of a new file that its folder does not exist.
TEST(FolderOwner, AFolderThatTakesNoFilesIsRefused) {
  expect_error([] { const FolderOwner owner("/proc/self"); }, {"/proc/self/.fathom.lock: cannot be created: "});
}

TEST(FolderOwner, RemovesOnlyWhatADeadWriterOfOursLeft) {
  const TemporaryFolder folder;
  make_directory(folder / "out");
  Child alive([] {});
  Child dead([] {});
  const pid_t gone = dead.process();
  dead.kill();
  const std::string of_dead = fmt::format("out/.depth.{}.fathom.part.exr", gone),
                    of_living = fmt::format("out/.depth.{}.fathom.part.exr", alive.process());
  for (const std::string& name :
       {of_dead, of_living, std::string("out/.notes.part"), std::string("out/.x.12.part.txt")})
    write_text(folder / name, "half");
  const FolderOwner owner(folder / "out");
  EXPECT_FALSE(fs::exists(folder / of_dead));
  EXPECT_TRUE(fs::exists(folder / of_living));
  EXPECT_TRUE(fs::exists(folder / "out/.notes.part"));
  EXPECT_TRUE(fs::exists(folder / "out/.x.12.part.txt"));
}

TEST(FolderOwner, AKilledWritersHalfFileIsALeftover) {
  const TemporaryFolder folder;
  make_directory(folder / "out");
  Child writer([&] {
    try {
      write_atomically(folder / "out/a.txt", [](const fs::path& beside) {
        write_text(beside, "half");
        throw 1;  // past the writer's clean-up, as a kill is
      });
    } catch (int) {
    }
  });
  writer.kill();
  EXPECT_FALSE(fs::is_empty(folder / "out"));
  { const FolderOwner owner(folder / "out"); }
  EXPECT_TRUE(fs::is_empty(folder / "out"));
}

}  // namespace
}  // namespace fathom
