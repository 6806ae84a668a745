// The program on files that were made to harm it, and where nobody listens.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/files.h"
#include "core/folder_owner.h"
#include "core/json.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

/// Exit code of a shell's command, −1 where a signal ended it.
int exit_code_of(const std::string& command) {
  const int status = std::system(fmt::format("exec timeout 60 {}", command).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string quoted(const std::filesystem::path& path) { return fmt::format("'{}'", path.string()); }

TEST(NobodyListens, AnErrorIsStillAnExitCode) {
  const std::string program = FATHOM_PROGRAM;
  for (const char* closed : {"2>&-", "2>/dev/full", ">&- 2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(exit_code_of(fmt::format("{} detect no_such_cloud.pcd {}", program, closed)), 1) << closed;
    EXPECT_EQ(exit_code_of(fmt::format("{} no_such_command {}", program, closed)), 2) << closed;
  }
}

TEST(NobodyListens, ResultsThatCannotBeWrittenAreAnError) {
  const std::string program = FATHOM_PROGRAM;
  for (const char* closed : {">&-", ">/dev/full"})
    for (const char* arguments : {"list media", "theory", "--help"})
      EXPECT_EQ(exit_code_of(fmt::format("{} {} {} 2>/dev/null", program, arguments, closed)), 1)
          << arguments << closed;
}

TEST(NobodyListens, PicturesAreDrawnWithoutAWordInAnyLocale) {
  const TemporaryFolder folder;
  const ProgramRun run = run_fathom(fmt::format("reproduce fig10 -o {} --quiet", quoted(folder / "out")), "LC_ALL=C");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
}

TEST(HostileFiles, AnErrorFitsOnAScreenWhateverItQuotes) {
  const TemporaryFolder folder;
  for (const char* piece : {"x", "é", "\\u001b"}) {
    std::string key;
    while (key.size() < 1'000'000) key += piece;
    write_text(folder / "scene.json", "{\"" + key + "\": 1}");
    const ProgramRun run =
        run_fathom(fmt::format("capture {} -o {}", quoted(folder / "scene.json"), quoted(folder / "out")));
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_LT(run.err.size(), 20'000U);
    EXPECT_TRUE(run.err.ends_with(" …\n")) << run.err.substr(0, 100);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
  }
}

TEST(HostileFiles, APipeIsNoScene) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "rig.json").c_str(), 0600), 0);
  write_text(folder / "frames.csv", "frame\n");
  for (const char* arguments :
       {"diagnose {0} -o {0}/out", "measure {0}", "capture {0}/rig.json -o {0}/out", "campaign {0}/rig.json -o {0}/out",
        "detect {0}/rig.json", "detect --live {0}/rig.json"}) {
    const ProgramRun run = run_fathom(fmt::format(fmt::runtime(arguments), quoted(folder / "")));
    EXPECT_EQ(run.exit_code, 1) << arguments;
    EXPECT_NE(run.err.find("is no regular file"), std::string::npos) << arguments << ": " << run.err;
  }
}

TEST(HostileFiles, AHeaderClaimsMemoryOnlyByLeave) {
  const TemporaryFolder folder;
  write_text(folder / "a.pcd",
             "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 190000000\nHEIGHT 1\nPOINTS "
             "190000000\nDATA binary_compressed\n" +
                 std::string("\x64\0\0\0\0\x0a\xe6\x87", 8) + std::string(100, '\0'));
  const std::string arguments = fmt::format("detect {}", quoted(folder / "a.pcd"));
  ProgramRun run = run_fathom(arguments);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("promises 5.32 GB of points, at most 1 GB is read; raise it with --max-input-mb"),
            std::string::npos)
      << run.err;
  run = run_fathom(arguments + " --max-input-mb 6000");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("cannot be packed in 100"), std::string::npos) << run.err;
}

TEST(HostileFiles, ASceneIsNoTallerThanAKilometre) {
  const TemporaryFolder folder;
  write_text(folder / "scene.json", R"({"sensor": {"model": "xtion_pro_live", "height_mm": 1e22, "pitch_deg": 60}})");
  const ProgramRun run = run_fathom(
      fmt::format("capture {} -o {} --mode geometric", quoted(folder / "scene.json"), quoted(folder / "out")));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("scene.json: /sensor/height_mm: must be a number above 0 and at most 1000000"),
            std::string::npos)
      << run.err;
}

TEST(HostileFiles, FramesNameCloudsBesideThem) {
  const TemporaryFolder folder;
  make_directory(folder / "campaign");
  write_text(folder / "secret.pcd", "no cloud");
  write_text(folder / "campaign/rig.json",
             R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.4},
                 "cup": {"shape": "paper_cup"}, "liquids": {"water": "water"}})");
  write_text(folder / "campaign/frames.csv",
             "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud\n"
             "0,0,0,0,0,0,empty,0,400,0,../secret.pcd\n");
  for (const char* command : {"measure", "diagnose"}) {
    const std::string arguments =
        fmt::format("{} {} -o {}", command, quoted(folder / "campaign"), quoted(folder / "out"));
    ProgramRun run = run_fathom(arguments);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("frames.csv: line 2, column 'cloud': names '../secret.pcd', which lies outside"),
              std::string::npos)
        << run.err;
    run = run_fathom(arguments + " --allow-outside");
    EXPECT_NE(run.err.find("is neither PCD nor PLY"), std::string::npos) << run.err;
  }
}

/// A table of 300 kB: 3,000 placements would take 1.2 GB of matrices.
TEST(HostileFiles, ATableIsDiagnosedOnlyWhereItsCovariancesHaveRoom) {
  const TemporaryFolder folder;
  make_directory(folder / "measured");
  write_text(folder / "measured/rig.json",
             R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": 58.4},
                 "cup": {"shape": "paper_cup"}, "liquids": {"water": "water"}})");
  std::string frames =
      "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud,height_mm\n";
  for (int i = 0; i < 3'000; ++i)
    frames += fmt::format("{0},0,0,{0},0,{0},empty,0,{1},0,,{2:.4f}\n", i, 250 + i % 100, 7.0 + 0.1 * std::sin(i));
  write_text(folder / "measured/frames.csv", frames);
  const ProgramRun run =
      run_fathom(fmt::format("diagnose {} -o {}", quoted(folder / "measured"), quoted(folder / "out")));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("frames.csv: promises 1.15 GB of covariances between 3000 observations, at most 1 GB is read; "
                         "raise it with --max-input-mb"),
            std::string::npos)
      << run.err;
}

/// Commands that write a single file, too.
TEST(AnOwnedFolder, TakesNoFileOfAnotherCommand) {
  const TemporaryFolder folder;
  const FolderOwner owner(folder / "out");
  for (const char* arguments :
       {"theory", "theory --max-skew", "list media", "verify fresnel --from 1 --to 1.333 --angle-deg 10"}) {
    const ProgramRun run = run_fathom(fmt::format("{} -o {}", arguments, quoted(folder / "out")));
    EXPECT_EQ(run.exit_code, 1) << arguments;
    EXPECT_NE(run.err.find("is being written by process"), std::string::npos) << arguments << ": " << run.err;
  }
}

}  // namespace
}  // namespace fathom
