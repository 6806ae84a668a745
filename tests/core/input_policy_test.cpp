// What files of others may claim: no memory but so much, no file but those beside them, and nobody waits for them.
#include "core/input_policy.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <limits>

#include "core/files.h"
#include "core/json.h"
#include "core/modest_json.h"
#include "core/table.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

TEST(InputPolicy, AScopeEndsWhereItsBraceDoes) {
  const std::uint64_t before = input_policy().most_bytes;
  {
    const InputPolicyScope scope({.most_bytes = 7, .allow_outside = true});
    EXPECT_EQ(input_policy().most_bytes, 7u);
    EXPECT_TRUE(input_policy().allow_outside);
  }
  EXPECT_EQ(input_policy().most_bytes, before);
  EXPECT_FALSE(input_policy().allow_outside);
}

TEST(InputPolicy, SizesThatMultiplyBeyondAnyTypeAreLarge) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(bytes_of({3, 5, 7}), 105u);
  EXPECT_EQ(bytes_of({1ull << 40, 1ull << 40}), kMost);
  EXPECT_EQ(bytes_of({1ull << 40, 1ull << 40, 0}), 0u);
}

TEST(InputPolicy, AClaimAboveTheLimitNamesTheOptionThatRaisesIt) {
  expect_error([] { require_within_limit("a.exr", "header", 13'700'000'000, "pixels"); },
               {"a.exr: header: promises 13.7 GB of pixels, at most 1 GB is read; raise it with --max-input-mb"});
  EXPECT_NO_THROW(require_within_limit("a.exr", "header", 1'000'000'000, "pixels"));
  const InputPolicyScope scope({.most_bytes = 14'000'000'000});
  EXPECT_NO_THROW(require_within_limit("a.exr", "header", 13'700'000'000, "pixels"));
}

struct NamesInFiles : testing::Test {
  NamesInFiles() {
    make_directory(folder / "scene/clouds");
    write_text(folder / "scene/clouds/a.pcd", "a");
    write_text(folder / "secret", "s");
    fs::create_symlink("../secret", folder / "scene/link");
    fs::create_symlink("clouds", folder / "scene/inner");
    fs::create_symlink("..", folder / "scene/up");
    fs::create_symlink("scene", folder / "alias");
  }
  fs::path named(const std::string& name) const { return path_named_in(file, "/cloud", name); }

  TemporaryFolder folder;
  std::string file = (folder / "scene/frames.csv").string();
};

TEST_F(NamesInFiles, StartAtTheFolderOfTheFile) {
  EXPECT_EQ(named("clouds/a.pcd"), folder / "scene/clouds/a.pcd");
  EXPECT_EQ(named("clouds/../b"), folder / "scene/clouds/../b");
  EXPECT_EQ(named("inner/a.pcd"), folder / "scene/inner/a.pcd");
  EXPECT_EQ(path_named_in((folder / "alias/frames.csv").string(), "", "clouds/a.pcd"), folder / "alias/clouds/a.pcd");
  EXPECT_EQ(path_named_in("frames.csv", "", "no/such/file"), fs::path("no/such/file"));
  EXPECT_EQ(path_named_in("no/such/folder/frames.csv", "", "a"), fs::path("no/such/folder/a"));
}

TEST_F(NamesInFiles, DoNotLeaveIt) {
  for (const char* name : {"../secret", "clouds/../../secret", "link", "up/secret", "..", ".", "../scene2/a"})
    expect_error([&] { named(name); },
                 {"frames.csv: /cloud: names '", name, "lies outside the folder", "--allow-outside"});
  for (const char* name : {"/etc/passwd", "//etc/passwd"})
    expect_error([&] { named(name); }, {"frames.csv: /cloud: names '", "is an absolute path", "--allow-outside"});
  expect_error([&] { path_named_in("no/such/frames.csv", "/cloud", "../../../a"); }, {"lies outside"});
}

TEST_F(NamesInFiles, LeaveItWhereThatIsAllowed) {
  const InputPolicyScope scope({.allow_outside = true});
  EXPECT_EQ(named("../secret"), folder / "scene/../secret");
  EXPECT_EQ(named("/etc/passwd"), fs::path("/etc/passwd"));
}

TEST_F(NamesInFiles, AreNames) {
  expect_error([&] { named(""); }, {"must be a file's name"});
  expect_error([&] { named(std::string("a.pcd\0.png", 10)); }, {"must be a file's name"});
  expect_error([&] { named("../a\nb"); }, {"names '../a?b'"});
  expect_error([&] { named(std::string(100'000, 'a')); }, {"frames.csv: /cloud: names 'aaa"});
}

/// Whoever waits for a writer that never comes is ended by the alarm.
struct SpecialFiles : testing::Test {
  SpecialFiles() { ::alarm(20); }
  ~SpecialFiles() override { ::alarm(0); }

  TemporaryFolder folder;
};

TEST_F(SpecialFiles, AreRefusedAtOnce) {
  const std::string pipe = (folder / "rig.json").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto start = std::chrono::steady_clock::now();
  const fs::path linked = folder / "frames.csv";
  fs::create_symlink("rig.json", linked);
  for (const fs::path& special : {fs::path(pipe), linked, fs::path("/dev/zero"), fs::path("/dev/null")}) {
    expect_error([&] { read_text(special); }, {special.string() + ": is no regular file"});
    expect_error([&] { read_json(special); }, {special.string() + ": is no regular file"});
    expect_error([&] { read_table(special); }, {special.string() + ": is no regular file"});
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST_F(SpecialFiles, SocketsAreRefused) {
  const std::string path = (folder / "s").string();
  ::sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(path.size(), sizeof address.sun_path);
  std::memcpy(address.sun_path, path.data(), path.size());
  const int server = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(server, reinterpret_cast<const ::sockaddr*>(&address), sizeof address), 0);
  expect_error([&] { read_text(path); }, {"is no regular file"});
  ::close(server);
}

TEST(Files, OfTheSystemHaveContentWithoutASize) { EXPECT_TRUE(read_text("/proc/self/stat").size() > 10); }

TEST(Files, LargerThanTheLimitAreNotRead) {
  const TemporaryFolder folder;
  write_text(folder / "sparse", "");
  fs::resize_file(folder / "sparse", std::uintmax_t{1} << 40);
  expect_error([&] { read_text(folder / "sparse"); }, {"sparse: promises 1.1 TB of content, at most 1 GB"});
  write_text(folder / "ten", "0123456789");
  const InputPolicyScope scope({.most_bytes = 9});
  expect_error([&] { read_text(folder / "ten"); }, {"ten: promises 10 bytes of content"});
}

TEST(Json, DeepNestingIsRefusedBeforeAParserSeesIt) {
  const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_NO_THROW(require_modest_json(nested(100), "a.json", {1, 1}));
  expect_error([&] { require_modest_json(nested(101), "a.json", {1, 1}); }, {"a.json: is nested more than 100 deep"});
  expect_error([&] { require_modest_json(std::string(1'000'000, '{'), "a.json", {1, 1}); }, {"nested"});
  EXPECT_NO_THROW(require_modest_json("\"" + nested(101) + "\\\"[[\"", "a.json", {1, 1})) << "brackets in a string";
  const InputPolicyScope policy({.most_bytes = 1'000'000});
  const std::string words = '"' + std::string(300'000, 'x') + '"';
  EXPECT_NO_THROW(require_modest_json(words, "a.json", {100, 3}));
  expect_error([&] { require_modest_json(words, "a.json", {100, 4}); }, {"a.json: promises 1.2 MB of values"});
  const TemporaryFolder folder;
  write_text(folder / "deep.json", std::string(20'000, '['));
  expect_error([&] { read_json(folder / "deep.json"); }, {"deep.json: is nested more than 100 deep"});
}

TEST(Json, ValuesThatWouldNotFitAreRefused) {
  const TemporaryFolder folder;
  std::string many = "[0";
  for (int i = 1; i < 1000; ++i) many += ",0";
  write_text(folder / "many.json", many + "]");
  EXPECT_EQ(read_json(folder / "many.json").size(), 1000u);
  const InputPolicyScope scope({.most_bytes = 50'000});
  expect_error([&] { read_json(folder / "many.json"); }, {"many.json: promises 108 kB of values"});
}

TEST(Table, MillionsOfColumnsAreRefused) {
  const TemporaryFolder folder;
  std::string header = "a0";
  for (int i = 1; i < 300'000; ++i) header += ",a" + std::to_string(i);
  write_text(folder / "wide.csv", header + "\n");
  expect_error([&] { read_table(folder / "wide.csv"); }, {"wide.csv: line 1: has more than 1000 columns"});
}

TEST(Table, BlankLinesCostNoTime) {
  const TemporaryFolder folder;
  write_text(folder / "blank.csv", "a,b\n" + std::string(3'000'000, '\n') + "1,\n\n");
  const Table table = read_table(folder / "blank.csv");
  ASSERT_EQ(table.rows(), 1u);
  EXPECT_EQ(table.text(0, "a"), "1");
}

}  // namespace
}  // namespace fathom
