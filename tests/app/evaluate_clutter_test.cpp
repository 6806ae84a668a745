// What `fathom evaluate recognition` and `liquid` promise: rates that anyone can shoot again, misses by their kind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files.h"
#include "core/json.h"
#include "core/table.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"
#include "tests/scene/vessels.h"
#include "tests/scene/write_gltf.h"

namespace fathom {
namespace {

/// A paper cup 300 mm away and one kind of object, small enough a scene for a test of seconds.
Json lone_cup() {
  return Json::parse(R"({
    "sensor": {"height_mm": 650, "aim_mm": [0, 350, 0], "noise": "basic"},
    "region_mm": {"x_mm": [-50, 50], "y_mm": [280, 320]},
    "cups": {"kinds": [{"shape": "paper_cup"}]},
    "objects": {"number": [0, 0], "kinds": [{"solid": "can"}]}
  })");
}

struct EvaluateClutter : testing::Test {
  TemporaryFolder folder;

  ProgramRun evaluate(const std::string& experiment, const Json& clutter, const std::string& options) {
    write_json(folder / "clutter.json", clutter);
    return run_fathom("evaluate " + experiment + " --clutter " + (folder / "clutter.json").string() + " --json " +
                      options);
  }
  std::string output(const char* name) const { return "-o " + (folder / name).string() + " "; }
};

Json value(const ProgramRun& run, const char* row) { return Json::parse(run.out).at(row).at("value"); }

TEST_F(EvaluateClutter, ALoneCupIsFoundAndItsContentKnown) {
  Json clutter = lone_cup();
  clutter["fillings"] = Json::parse(R"([{}, {"liquid": "water", "fill_mm": 30}])");
  const ProgramRun run = evaluate("liquid", clutter, "--trials 2 " + output("out"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(value(run, "recognised"), "4/4");
  EXPECT_EQ(value(run, "sensitivity"), "2/2");
  EXPECT_EQ(value(run, "specificity"), "2/2");
  EXPECT_EQ(value(run, "precision"), "4/4");
  EXPECT_EQ(value(run, "sensitivity_30_mm"), "2/2");
  EXPECT_EQ(value(run, "kind_right"), "2/2");
  EXPECT_EQ(value(run, "fill_within_95"), "2/2");
  EXPECT_LT(value(run, "p_liquid_calibration_error"), 0.01);  // certain in plain sight, and right
  EXPECT_GT(value(run, "detect_walls_median"), 0.0);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/reliability.png"));
  const Table fillings = read_table(folder / "out/fillings.csv");
  ASSERT_EQ(fillings.rows(), 2u);
  EXPECT_EQ(fillings.text(1, "liquid"), "water");
  EXPECT_EQ(fillings.text(1, "liquid_detected"), "2");
  EXPECT_EQ(read_table(folder / "out/cups.csv").rows(), 4u);
}

TEST_F(EvaluateClutter, AMergedCupIsCalledSoAndCanBeShotAgain) {
  Json clutter = lone_cup();
  clutter["touching"] = 1.0;
  clutter["objects"]["number"] = {1, 1};
  const ProgramRun run = evaluate("recognition", clutter, "--method paper --trials 1 " + output("out"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(value(run, "recognised"), "0/1");
  EXPECT_EQ(value(run, "missed_merged"), 1.0);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/failures/000000_merged.png"));
  const std::string page = read_text(folder / "out/failures/index.html");
  EXPECT_NE(page.find("<td>1</td><td>merged</td>"), std::string::npos);
  EXPECT_NE(page.find("<td>0</td><td>occluded</td>"), std::string::npos);
  EXPECT_NE(page.find("src=\"000000_merged.png\""), std::string::npos);
  const std::string scene = (folder / "out/failures/000000_merged.json").string();
  EXPECT_EQ(run_fathom("capture " + scene + " --mode geometric " + output("again")).exit_code, 0);
}

TEST_F(EvaluateClutter, ThePageOfFailuresShowsThoseOfTheTrialsAskedFor) {
  Json clutter = lone_cup();
  clutter["touching"] = 1.0;
  clutter["objects"]["number"] = {1, 1};
  const auto pictures = [&](int trials) {
    evaluate("recognition", clutter, fmt::format("--method paper --trials {} ", trials) + output("out"));
    const std::string page = read_text(folder / "out/failures/index.html");
    int count = 0;
    for (std::size_t at = page.find("<figure>"); at != std::string::npos; at = page.find("<figure>", at + 1)) ++count;
    return count;
  };
  EXPECT_GT(pictures(4), 1);
  EXPECT_EQ(pictures(1), 1);
}

TEST_F(EvaluateClutter, GoesOnWhereItStoppedWithTheSameBytes) {
  const auto cups = [&](const char* name) { return read_text(folder / name / "cups.csv"); };
  ASSERT_EQ(evaluate("recognition", lone_cup(), "--trials 1 " + output("pieces")).exit_code, 0);
  const auto killed = folder / "pieces" / "templates" / ".paper_cup.999999.fathom.part.json";
  write_text(killed, "{");
  ASSERT_EQ(evaluate("recognition", lone_cup(), "--trials 3 " + output("pieces")).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(killed));
  ASSERT_EQ(evaluate("recognition", lone_cup(), "--trials 3 --threads 1 " + output("whole")).exit_code, 0);
  EXPECT_EQ(cups("pieces"), cups("whole"));
}

TEST_F(EvaluateClutter, TrialsOfAnotherMeshAreNeverMixedIn) {
  const auto write_cup = [&](double radius) {
    write_gltf(folder / "cup.gltf", sheet_of_revolution({{0.0, 0.004}, {radius, 0.004}, {radius, 0.09}}));
  };
  Json clutter = lone_cup();
  clutter["cups"]["kinds"] = {{{"shape", "cup.gltf"}}};
  write_cup(0.040);
  ASSERT_EQ(evaluate("recognition", clutter, "--trials 1 " + output("out")).exit_code, 0);
  write_cup(0.038);  // the same text in cup.gltf, other numbers in its buffer
  const ProgramRun run = evaluate("recognition", clutter, "--trials 2 " + output("out"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("cup.bin has changed; choose another folder"), std::string::npos) << run.err;
}

TEST_F(EvaluateClutter, RefusesAFolderOfAnotherEvaluation) {
  ASSERT_EQ(evaluate("recognition", lone_cup(), "--trials 1 " + output("out")).exit_code, 0);
  const ProgramRun run = evaluate("recognition", lone_cup(), "--trials 1 --seed 2 " + output("out"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("manifest.jsonl: is of another run: seed was 1, is 2; choose another folder"),
            std::string::npos)
      << run.err;
}

TEST_F(EvaluateClutter, OptionsThatSayNothingAreRefused) {
  EXPECT_EQ(run_fathom("evaluate recognition --height-mm 650 --pitch-deg 60").exit_code, 2);
  EXPECT_EQ(run_fathom("evaluate some_folder --trials 3").exit_code, 2);
}

}  // namespace
}  // namespace fathom
