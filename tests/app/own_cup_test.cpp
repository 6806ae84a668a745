// What every cup must give, whatever its walls: campaign → diagnose is a round trip, silent where nothing is hidden.
#include <gtest/gtest.h>

#include "core/files.h"
#include "core/json.h"
#include "core/library.h"
#include "core/table.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

// Geometric captures with the device's noise: thirty milliseconds each.
const Json kSpec = Json::parse(R"({
  "sensor": {"model": "xtion_pro_live", "noise": "device", "height_mm": 650, "aim_mm": [0, 300, 0]},
  "liquids": {"water": "water", "paint": {"index": 1.336, "scattering_per_mm": 1000}},
  "fillings": [{"liquid": "empty"}, {"liquid": "water", "fill_mm": 20}, {"liquid": "water", "fill_mm": 40},
               {"liquid": "paint", "fill_mm": 30}],
  "distance_mm": [200, 300], "lateral_mm": [-80, 80], "bare_desk_views": 3, "pours": 3, "trials": 2,
  "mode": "geometric"})");

/// A laboratory's own: its wall leans by a quarter, and more at the foot.
const Json kOwn = Json::parse(R"({"inner_profile_mm": [[0, 6], [24, 6], [30, 26], [38, 72]],
                                  "outer_profile_mm": [[0, 0], [26, 0], [33, 26], [41, 72]]})");

struct OwnCup : testing::TestWithParam<std::string> {
  TemporaryFolder folder;

  Json shape() const { return GetParam() == "own" ? kOwn : Json(GetParam()); }
  std::string path(const std::string& name) const { return (folder / name).string(); }

  Json diagnosis_with(const Json& effects) {
    Json spec = kSpec;
    spec["cup"]["shape"] = shape();
    spec["effects"] = effects;
    write_json(folder / "spec.json", spec);
    const ProgramRun campaign = run_fathom("campaign " + path("spec.json") + " -o " + path("campaign"));
    EXPECT_EQ(campaign.exit_code, 0) << campaign.err;
    const ProgramRun run = run_fathom("diagnose " + path("campaign") + " -o " + path("out"));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read_json(folder / "out" / "report.json");
  }
};

TEST_P(OwnCup, WithNothingHiddenAgreesWithItsModel) {
  const Json report = diagnosis_with(Json::array());
  EXPECT_EQ(report["verdict"], "none") << report["answer"];
}

TEST_P(OwnCup, ThatHoldsMoreThanIsWrittenIsFound) {
  const Json report = diagnosis_with({{{"name", "fill_scale"}, {"scale", 0.15}}});
  ASSERT_EQ(report["verdict"], "named") << report["answer"];
  ASSERT_EQ(report["effects"].size(), 1u);
  EXPECT_EQ(report["effects"][0]["name"], "fill_scale");
  const Json& scale = report["effects"][0]["parameters"]["scale"];
  EXPECT_LT(scale["ci95"][0].get<double>(), 0.15);
  EXPECT_GT(scale["ci95"][1].get<double>(), 0.15);
}

std::vector<std::string> cups() {
  std::vector<std::string> names = library_names("cups");
  std::erase(names, "paper_cup");  // diagnose_test.cpp has it
  names.emplace_back("own");
  return names;
}
INSTANTIATE_TEST_SUITE_P(Cups, OwnCup, testing::ValuesIn(cups()), [](const auto& cup) { return cup.param; });

/// A cup that is narrow below has no wall among its heights: they are those of its bottom.
TEST(OwnCupHeights, HoldNoWall) {
  const TemporaryFolder folder;
  Json spec = kSpec;
  spec["sensor"]["noise"] = "off";
  spec["cup"]["shape"] = Json::parse(R"({"inner_profile_mm": [[0, 6], [20, 6], [45, 80]],
                                         "outer_profile_mm": [[0, 0], [23, 0], [48, 80]]})");
  spec["fillings"] = {{{"liquid", "empty"}}};
  spec["pours"] = 1, spec["trials"] = 1, spec["bare_desk_views"] = 0;
  write_json(folder / "spec.json", spec);
  ASSERT_EQ(run_fathom("campaign " + (folder / "spec.json").string() + " -o " + (folder / "c").string()).exit_code, 0);
  ASSERT_EQ(run_fathom("measure " + (folder / "c").string()).exit_code, 0);
  const Table heights = read_table(folder / "c" / "heights.csv");
  ASSERT_EQ(heights.rows(), 4u);
  for (std::size_t row = 0; row < heights.rows(); ++row)
    EXPECT_NEAR(heights.number(row, "height_mm"), 6.0, 0.4) << row;  // steps of 1 mm over some hundred points
}

}  // namespace
}  // namespace fathom
