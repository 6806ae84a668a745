// What `fathom evaluate` of a data set promises: rates that add up, the same answers whoever gives them, and one line
// about what cannot be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/files.h"
#include "core/json.h"
#include "core/table.h"
#include "tests/app/run_fathom.h"
#include "tests/core/files_below.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace evaluate_dataset_test {

namespace fs = std::filesystem;

constexpr const char* kSpec = R"({
  "sensor": {"models": ["xtion_pro_live_device"], "height_mm": [600, 700]},
  "cups": {"number": [1, 1], "kinds": [{"shape": "paper_cup"}]}, "objects": {"number": [0, 1], "kinds": [{"solid": "can"}]},
  "region_mm": {"x_mm": [-100, 100], "y_mm": [300, 400]}, "liquids": ["whole_milk"], "fill_share": [0.3, 0.6], "empty": 0.4
})";
constexpr int kFrames = 103;  // in two folders

struct EvaluateDataset : testing::Test {
  static TemporaryFolder& shared() {
    static TemporaryFolder folder;
    return folder;
  }
  static fs::path frames() { return shared() / "frames"; }

  static void SetUpTestSuite() {
    write_text(shared() / "spec.json", kSpec);
    const ProgramRun made = run_fathom(fmt::format("generate {} --frames {} --quiet -o {}",
                                                   (shared() / "spec.json").string(), kFrames, frames().string()));
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }

  TemporaryFolder folder;

  ProgramRun evaluate(const std::string& to, const std::string& options = "", const fs::path& of = frames()) {
    return run_fathom(fmt::format("evaluate {} --json --quiet -o {} {}", of.string(), (folder / to).string(), options));
  }
};

TEST_F(EvaluateDataset, TheCardCountsEveryCupOnceInEachFactor) {
  const ProgramRun run = evaluate("card");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json rates = Json::parse(run.out);
  EXPECT_EQ(rates.at("trials").at("value"), kFrames);
  EXPECT_EQ(rates.at("recognised").at("value"), fmt::format("{0}/{0}", kFrames));  // in plain sight, half full at most
  const Table card = read_table(folder / "card/card.csv");
  std::map<std::string, int> cups, frames_seen;
  for (std::size_t row = 0; row < card.rows(); ++row) {
    const int of = static_cast<int>(card.number(row, "of"));
    if (card.text(row, "rate") == "recognised") cups[card.text(row, "factor")] += of;
    if (card.text(row, "rate") == "false cup") frames_seen[card.text(row, "factor")] += of;
  }
  EXPECT_EQ(cups.size(), 7u);
  for (const auto& [factor, count] : cups) EXPECT_EQ(count, kFrames) << factor;
  for (const auto& [factor, count] : frames_seen) EXPECT_EQ(count, kFrames) << factor;
  for (const char* name : {"card.png", "card.svg", "index.html", "reliability.png", "rates.json"})
    EXPECT_TRUE(fs::exists(folder / "card" / name)) << name;
}

TEST_F(EvaluateDataset, WhatIsTrueOfACupIsWhatItsSceneSays) {
  ASSERT_EQ(evaluate("card").exit_code, 0);
  const Table cups = read_table(folder / "card/cups.csv");
  ASSERT_EQ(cups.rows(), static_cast<std::size_t>(kFrames));
  for (std::size_t row = 0; row < cups.rows(); row += 17) {
    const std::string name = cups.text(row, "trial");  // "000000_000017"
    const Json scene =
        read_json(frames() / "train" / name.substr(0, 6) / "labels" / (name.substr(7) + ".json")).at("scene");
    const Json& cup = scene.at("cups").at(0);
    EXPECT_NEAR(cups.number(row, "x_mm"), cup.at("position_mm").at(0), 0.06);
    EXPECT_NEAR(cups.number(row, "y_mm"), cup.at("position_mm").at(1), 0.06);
    EXPECT_EQ(cups.text(row, "liquid"), cup.value("liquid", "empty"));
    EXPECT_NEAR(cups.number(row, "fill_mm"), cup.value("fill_mm", 0.0), 1e-3);
  }
}

TEST_F(EvaluateDataset, ShardsAndARepeatedRunGiveTheSameBytes) {
  ASSERT_EQ(evaluate("whole").exit_code, 0);
  const ProgramRun first = evaluate("parts", "--shard 1/2 --threads 1");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(Json::parse(first.out).at("complete").at("value"), "no");
  EXPECT_FALSE(fs::exists(folder / "parts/rates.json"));
  ASSERT_EQ(evaluate("parts", "--shard 0/2").exit_code, 0);
  EXPECT_EQ(files_below(folder / "parts"), files_below(folder / "whole"));
  fs::remove(folder / "parts/scenes/000001/trials/000002.json");
  ASSERT_EQ(evaluate("parts").exit_code, 0);
  EXPECT_EQ(files_below(folder / "parts"), files_below(folder / "whole"));
}

TEST_F(EvaluateDataset, AnotherMethodsAnswersAreNotMixed) {
  ASSERT_EQ(evaluate("card").exit_code, 0);
  const auto card = files_below(folder / "card");
  const ProgramRun other = evaluate("card", "--method paper");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("method was \"robust\", is \"paper\""), std::string::npos) << other.err;
  EXPECT_EQ(files_below(folder / "card"), card);  // a refused run leaves the other's card as it was
  ASSERT_EQ(evaluate("shards", "--shard 0/2").exit_code, 0);
  EXPECT_EQ(evaluate("shards", "--shard 1/2 --method paper").exit_code, 1);
}

TEST_F(EvaluateDataset, WhatCannotBeIsRefusedWithItsPlace) {
  const auto broken = [&](const std::string& name, const std::function<void(Json&)>& change) {
    fs::copy(frames(), folder / name, fs::copy_options::recursive);
    const fs::path file = folder / name / "train/000001/labels/000001.json";
    Json labels = read_json(file);
    change(labels);
    write_json(file, labels);
    return evaluate(name + "_card", "--shard 1/2", folder / name);
  };
  const ProgramRun beyond =
      broken("beyond", [](Json& labels) { labels["instances"][0]["visible"]["counts"].push_back(10); });
  EXPECT_EQ(beyond.exit_code, 1);
  EXPECT_NE(beyond.err.find("labels/000001.json: /instances/0/visible/counts: must not go beyond the image"),
            std::string::npos)
      << beyond.err;
  const ProgramRun skewed = broken("skewed", [](Json& labels) { labels["camera"]["cam_R_w2c"][0] = 0.2; });
  EXPECT_EQ(skewed.exit_code, 1);
  EXPECT_NE(skewed.err.find("/camera/cam_R_w2c: must be a rotation"), std::string::npos) << skewed.err;
  EXPECT_EQ(std::count(skewed.err.begin(), skewed.err.end(), '\n'), 1);
}

TEST_F(EvaluateDataset, ShardsAreForDataSets) {
  EXPECT_EQ(run_fathom("evaluate recognition --shard 0/2 --trials 1").exit_code, 2);
  EXPECT_EQ(evaluate("card", "--shard 2/2").exit_code, 2);
  EXPECT_EQ(evaluate("card", "--trials 3").exit_code, 2);
}

}  // namespace evaluate_dataset_test
}  // namespace fathom
