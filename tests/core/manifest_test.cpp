// What a run may go on with: files that stand as they were written, by the same program, options and inputs.
#include "core/manifest.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/files.h"
#include "core/hash.h"
#include "core/input_record.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

const RunIdentity kRun{
    "campaign", {{"seed", 1}, {"spp", 4}}, {{"spec.json", sha256("spec")}, {"cup.json", sha256("cup")}}};

/// A folder in which a run was killed after two files.
struct KilledRun : testing::Test {
  TemporaryFolder folder;

  void SetUp() override {
    Manifest manifest(folder / "", kRun);
    EXPECT_FALSE(manifest.exists());
    manifest.begin();
    for (const char* name : {"b.pcd", "a.pcd"}) {
      write_text(folder / name, name);
      manifest.add(name);
    }
  }
  Manifest again(const RunIdentity& run = kRun) { return Manifest(folder / "", run); }
};

TEST(Hash, IsSha256) {
  // FIPS 180-4's examples, as NIST publishes them.
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const TemporaryFolder folder;
  const std::string long_text(3'000'000, 'x');
  write_text(folder / "f", long_text);
  EXPECT_EQ(sha256_of_file(folder / "f"), sha256(long_text));
  expect_error([&] { sha256_of_file(folder / "no"); }, {"no: cannot be read"});
}

TEST(InputRecord, NotesWhatIsReadWhileItLives) {
  const TemporaryFolder folder;
  write_text(folder / "a", "1");
  write_text(folder / "b", "2");
  read_text(folder / "a");
  const InputRecord record;
  read_text(folder / "b");
  EXPECT_EQ(record.files(), (std::map<std::string, std::string>{{(folder / "b").string(), sha256("2")}}));
}

TEST_F(KilledRun, GoesOnWithWhatItHad) {
  Manifest manifest = again();
  EXPECT_TRUE(manifest.exists());
  EXPECT_FALSE(manifest.difference());
  EXPECT_TRUE(manifest.holds("a.pcd"));
  EXPECT_TRUE(manifest.holds("b.pcd"));
  EXPECT_FALSE(manifest.holds("c.pcd"));
}

TEST_F(KilledRun, AFileThatWasOverwrittenDoesNotCount) {
  write_text(folder / "a.pcd", "A.pcd");  // of the same size
  std::filesystem::remove(folder / "b.pcd");
  EXPECT_FALSE(again().holds("a.pcd"));
  EXPECT_FALSE(again().holds("b.pcd"));
}

TEST_F(KilledRun, ALineThatWasCutShortDoesNotCount) {
  const std::string text = read_text(folder / "manifest.jsonl");
  for (std::size_t cut = 1; cut < 100; ++cut) {  // the last line is longer
    std::ofstream(folder / "manifest.jsonl", std::ios::binary) << text.substr(0, text.size() - cut);
    Manifest manifest = again();
    EXPECT_TRUE(manifest.holds("b.pcd"));
    EXPECT_EQ(manifest.holds("a.pcd"), cut == 1) << cut;  // without its line's end it is whole
    manifest.begin();
    manifest.add("a.pcd");
    EXPECT_TRUE(again().holds("a.pcd"));
  }
}

TEST_F(KilledRun, ALineThatSaysTooLittleDoesNotCount) {
  const std::string text = read_text(folder / "manifest.jsonl"), identity = text.substr(0, text.find('\n') + 1);
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  for (const std::string& line :
       {std::string(R"({"file": "a.pcd"})"), std::string(R"({"file": "a.pcd", "bytes": 5})"),
        std::string(R"({"file": "a.pcd", "bytes": null, "sha256": null})"),
        R"({"file": "a.pcd", "sha256": ")" + sha256("a.pcd") + R"(", "bytes": 5.0})",
        R"({"file": "a.pcd", "sha256": ")" + sha256("a.pcd") + R"(", "bytes": 5, "x": )" + deep + "}"}) {
    std::ofstream(folder / "manifest.jsonl", std::ios::binary) << identity << line << '\n';
    Manifest manifest = again();
    EXPECT_FALSE(manifest.difference()) << line.substr(0, 80);
    EXPECT_FALSE(manifest.holds("a.pcd")) << line.substr(0, 80);
    manifest.begin();
    EXPECT_EQ(read_text(folder / "manifest.jsonl"), identity) << line.substr(0, 80);
  }
}

TEST_F(KilledRun, EndsInTheOrderOfNamesWhicheverWayItWent) {
  Manifest manifest = again();
  manifest.begin();
  manifest.finish();
  const std::string pieces = read_text(folder / "manifest.jsonl");
  EXPECT_LT(pieces.find("a.pcd"), pieces.find("b.pcd"));
}

TEST_F(KilledRun, SaysWhatPartsItFromAnotherRun) {
  const auto expect_difference = [&](const RunIdentity& run, const std::string& words) {
    expect_error([&] { again(run).require_same_run(); },
                 {(folder / "manifest.jsonl").string() + ": is of another run: " + words + "; choose another folder"});
  };
  RunIdentity run = kRun;
  run.options["seed"] = 2;
  expect_difference(run, "seed was 1, is 2");
  run = kRun;
  run.inputs["cup.json"] = sha256("another cup");
  expect_difference(run, "cup.json has changed");
  run = kRun;
  run.command = "evaluate";
  expect_difference(run, "it was made by another command");
  run = kRun;
  run.inputs.erase("cup.json");
  expect_difference(run, "it had other options or files");
}

TEST_F(KilledRun, WhoseFilesAreClearedAwayIsStillAnother) {
  RunIdentity run = kRun;
  run.options["seed"] = 2;
  again(run).forget_files();
  EXPECT_TRUE(again(run).difference());
  EXPECT_FALSE(again().difference());
  EXPECT_FALSE(again().holds("a.pcd"));
}

TEST_F(KilledRun, IsTheSameWhereItsFilesWereMoved) {
  RunIdentity moved = kRun;
  moved.inputs = {{"/elsewhere/spec.json", sha256("spec")}, {"/elsewhere/cup.json", sha256("cup")}};
  EXPECT_FALSE(again(moved).difference());
}

TEST_F(KilledRun, AnotherBuildIsAnotherRun) {
  std::string text = read_text(folder / "manifest.jsonl");
  const std::size_t at = text.find("\"program\":\"") + 11;
  text[at] = text[at] == '0' ? '1' : '0';
  write_text(folder / "manifest.jsonl", text);
  expect_error([&] { again().require_same_run(); }, {"the program is another build"});
}

TEST_F(KilledRun, ADamagedManifestIsOfAnotherRun) {
  for (const char* text : {"", "\n", "{", "[1,2]", "7", "{\"command\": 1}", "\xff\xfe"}) {
    write_text(folder / "manifest.jsonl", text);
    EXPECT_TRUE(again().difference()) << text;
    EXPECT_FALSE(again().holds("a.pcd")) << text;
  }
}

TEST_F(KilledRun, AnOptionThatIsNestedWithoutEndIsOfAnotherRun) {
  std::string text = read_text(folder / "manifest.jsonl");
  const std::string was = "\"seed\":1";
  const std::size_t at = text.find(was);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, was.size(), "\"seed\":" + std::string(300'000, '[') + std::string(300'000, ']'));
  write_text(folder / "manifest.jsonl", text);
  expect_error([&] { again().require_same_run(); }, {"is of another run"});
}

}  // namespace
}  // namespace fathom
