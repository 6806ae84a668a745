// What a diagnosis asks a blind laboratory to measure next is measured at the same rig, and settles what it is to
// settle.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "blind/laboratory.h"
#include "blind/settle.h"
#include "blind/write_set.h"
#include "core/error.h"
#include "core/files.h"
#include "tests/app/run_fathom.h"

namespace fathom::blind {
namespace {

namespace fs = std::filesystem;

struct BlindSession : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  Json spec = {{"sensor", {{"model", "xtion_pro_live"}, {"height_mm", 650.0}}},
               {"cup", {{"shape", "paper_cup"}}},
               {"liquids", {{"water", "water"}, {"opaque_liquid", {{"index", 1.34}, {"scattering_per_mm", 1000}}}}},
               {"fillings", {{{"liquid", "empty"}}, {{"liquid", "opaque_liquid"}, {"fill_mm", 30.0}}}},
               {"distance_mm", {200.0, 400.0}},
               {"lateral_mm", {-120.0}},
               {"bare_desk_views", 3},
               {"pours", 2},
               {"placements", 2},
               {"trials", 3},
               {"placement_s", 1800.0}};
  void SetUp() override {
    fs::remove_all(folder);
    make_directory(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  FollowUp read() const {
    write_json(folder / "next_1.json", spec);
    return read_follow_up(folder / "next_1.json");
  }
  std::string refusal() const {
    try {
      read();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(BlindSession, IsAnotherOneOfTheSameLaboratory) {
  const std::vector<Placement> earlier = plan(design("one_distance"), 7);
  const std::vector<Placement> placements = plan(read(), earlier);
  ASSERT_EQ(placements.size(), 1u + 2 * 2 * 2 * 2);
  std::set<int> pours, numbers;
  for (const Placement& p : earlier) pours.insert(p.pour), numbers.insert(p.number);
  const std::size_t old_pours = pours.size();
  for (const Placement& p : placements) {
    EXPECT_EQ(p.session, earlier.back().session + 1);
    EXPECT_TRUE(numbers.insert(p.number).second);  // put down and out of place anew
    if (p.has_cup()) pours.insert(p.pour);
  }
  EXPECT_EQ(pours.size(), old_pours + 4);
  EXPECT_EQ(placements.front().liquid, "none");
  EXPECT_EQ(placements.front().trials, 3);
  // Poured and shot; then half an hour each time.
  EXPECT_EQ(placements[1].since_poured_s, 0.0);
  EXPECT_EQ(placements[2].since_poured_s, 1800.0 + kSecondsPerPlacement + 3 * kSecondsPerTrial);
  // One unit, set up anew: a baseline's error is the same, a pose's is not.
  const World before = true_world(earlier.front(), 7, 1.0), after = true_world(placements.back(), 7, 1.0);
  EXPECT_EQ(before.sensor.baseline, after.sensor.baseline);
  EXPECT_NE(before.sensor.height, after.sensor.height);
}

TEST_F(BlindSession, RefusesWhatItsLaboratoryDoesNotHave) {
  EXPECT_EQ(refusal(), "");
  spec["sensor"]["height_mm"] = 700;
  EXPECT_NE(refusal().find("/sensor/height_mm: must be as in rig.json"), std::string::npos) << refusal();
  spec["sensor"].erase("height_mm");
  spec["fillings"][0]["liquid"] = "beer";
  EXPECT_NE(refusal().find("/fillings/0/liquid: must be one of empty, water"), std::string::npos) << refusal();
  spec["fillings"].clear();
  spec["distance_mm"] = {2000.0};
  EXPECT_NE(refusal().find("/distance_mm/0: must be a number from 150 to 550"), std::string::npos) << refusal();
}

TEST_F(BlindSession, TellsTwinsApart) {
  // Milk alone: a bottom that is 3 mm higher, or fills that are.
  SetTruth truth{.number = 0, .seed = 21, .kind = "aliased", .design = "opaque_only"};
  truth.aliased = {"cup_bottom_height", "fill_offset"};
  truth.effects.push_back({{&hidden_effect("cup_bottom_height"), 3.0}, 15.0});
  const auto diagnosed = [&](const std::string& folders, const fs::path& answer) {
    const ProgramRun run = run_fathom("diagnose " + folders + " -o " + answer.string() + " --quiet");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read_answer(answer);
  };
  const std::string set = (folder / "set").string(), more = (folder / "more").string();
  write_set(truth, set);
  Judged one{truth, diagnosed(set, folder / "answer")};
  const std::optional<Promise> promise = promise_of(one.answer);
  ASSERT_TRUE(promise);
  EXPECT_GT(rivals(one).size(), 0u);
  write_follow_up(truth, read_follow_up(folder / "answer" / promise->spec), more);
  one.followed = diagnosed(set + " " + more, folder / "followed");
  EXPECT_TRUE(is_settled(one)) << promise->measurement;
}

}  // namespace
}  // namespace fathom::blind
