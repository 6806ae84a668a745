// What a pack promises: shares, secrets, the same bytes for the same seed.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "blind/ledger.h"
#include "blind/pack.h"
#include "blind/strength.h"
#include "blind/write_set.h"
#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/table.h"
#include "tests/app/run_fathom.h"

namespace fathom::blind {
namespace {

namespace fs = std::filesystem;

struct BlindPack : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override {
    fs::remove_all(folder);
    make_directory(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
};

TEST(Sha256, GivesTheStandardsDigests) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(BlindKinds, ComeInTheirShares) {
  std::map<std::string, int> kinds;
  for (const std::string& kind : kinds_of_pack(3, 200)) ++kinds[kind];
  const std::map<std::string, int> wanted{{"null", 60},    {"single", 60},  {"pair", 24},        {"triple", 6},
                                          {"unknown", 30}, {"aliased", 10}, {"book_keeping", 10}};
  EXPECT_EQ(kinds, wanted);
}

TEST_F(BlindPack, HidesWhatItsKindsSay) {
  constexpr int kSets = 5;
  seal_pack("development", 3, kSets, folder / "pack", folder / "truth.json", "");
  for (const SetTruth& set : open_pack(folder / "pack", folder / "truth.json").sets) {
    EXPECT_EQ(set.kind == "null" || set.kind == "book_keeping", set.effects.empty()) << set.kind;
    EXPECT_EQ(set.aliased.size(), set.kind == "aliased" ? 2u : 0u);
    for (const Truth& hidden : set.effects) EXPECT_GT(hidden.strength, 1.0);
  }
  // Nothing in the pack's folder says what is hidden.
  EXPECT_EQ(read_text(folder / "pack/pack.json").find("departure"), std::string::npos);
}

TEST_F(BlindPack, TheTruthIsOneFileWhoseHashIsKnownBefore) {
  EXPECT_THROW(seal_pack("development", 3, 1, folder / "pack", folder / "pack/truth.json", ""), Error);
  seal_pack("development", 3, 1, folder / "pack", folder / "truth.json", "");
  write_text(folder / "truth.json", read_text(folder / "truth.json") + " ");
  EXPECT_THROW(open_pack(folder / "pack", folder / "truth.json"), Error);
}

TEST_F(BlindPack, SameSeedSameBytesAndMeasureReadsThem) {
  SetTruth truth{.number = 0, .seed = 11, .kind = "single", .design = "one_distance"};
  truth.effects.push_back({{&hidden_effect("fill_offset"), 2.0}, 0.0});
  const int frames = write_set(truth, folder / "a");
  write_set(truth, folder / "b");
  std::size_t clouds = 0;
  for (const auto& entry : fs::directory_iterator(folder / "a/clouds")) {
    ++clouds;
    EXPECT_EQ(read_text(entry.path()), read_text(folder / "b/clouds" / entry.path().filename()));
  }
  EXPECT_EQ(read_text(folder / "a/frames.csv"), read_text(folder / "b/frames.csv"));
  EXPECT_EQ(clouds, static_cast<std::size_t>(frames));

  const ProgramRun run = run_fathom("measure " + (folder / "a").string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const Table heights = read_table(folder / "a/heights.csv");
  const auto mean_of = [&](std::string_view liquid, std::string_view fill_mm) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t row = 0; row < heights.rows(); ++row)
      if (heights.text(row, "liquid") == liquid && heights.text(row, "fill_mm") == fill_mm) {
        sum += heights.number(row, "height_mm");
        ++count;
      }
    return sum / count;
  };
  // 20 + 2 mm above the empty cup's bottom, in the same places, where the unit is off by the same; three fills of
  // ± 0.5 mm leave ± 0.3.
  EXPECT_NEAR(mean_of("milk_tea", "20") - mean_of("empty", "0"), 22.0, 0.8);
}

TEST_F(BlindPack, HeightsOnlyAreATableWithoutClouds) {
  const SetTruth truth{.number = 0, .seed = 12, .kind = "null", .design = "heights_only"};
  write_set(truth, folder / "a");
  EXPECT_FALSE(fs::exists(folder / "a/clouds"));
  const ProgramRun run = run_fathom("measure " + (folder / "a").string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(BlindPack, TheLedgerIsOnlyAddedTo) {
  const fs::path ledger = folder / "ledger.csv";
  add_to_ledger(ledger,
                {.event = "made", .pack = "a", .kind = "sealed", .seed = 20001, .sets = 5, .truth_sha256 = "x"});
  EXPECT_FALSE(opened_at(ledger, "x"));
  add_to_ledger(ledger,
                {.event = "opened", .pack = "a", .kind = "sealed", .seed = 20001, .sets = 5, .truth_sha256 = "x"});
  EXPECT_TRUE(opened_at(ledger, "x"));
  EXPECT_EQ(read_ledger(ledger).size(), 2u);
  // The seed of a sealed pack is used up.
  EXPECT_THROW(add_to_ledger(ledger, {.event = "made", .pack = "b", .kind = "sealed", .seed = 20001}), Error);
  std::string text = read_text(ledger);
  text.replace(text.find("20001"), 5, "20002");
  write_text(ledger, text);
  EXPECT_THROW(read_ledger(ledger), Error);
}

TEST(BlindSeeds, OfPackKindsAreDisjoint) {
  std::uint64_t last = 0;
  for (const PackKind& kind : pack_kinds()) {
    EXPECT_GT(kind.first_seed, last);
    last = kind.last_seed;
    EXPECT_NO_THROW(require_seed(kind.name, kind.first_seed));
    EXPECT_THROW(require_seed(kind.name, kind.last_seed + 1), Error);
  }
}

struct BlindStrength : testing::Test {
  static inline Views views;
  static void SetUpTestSuite() { views = views_of(designs()); }
  static Strengths of(const char* name) { return {design(name), plan(design(name), 1), views}; }
};

TEST_F(BlindStrength, GrowsWithTheEffectAndReachesWhatIsAsked) {
  const Strengths strengths = of("one_distance");
  const Hidden& fill = hidden_effect("fill_offset");
  const double one = strengths.shown({&fill, 1.0}).s;
  EXPECT_GT(one, 1.0);
  EXPECT_NEAR(strengths.shown({&fill, 2.0}).s / one, 2.0, 0.1);  // sensitivities are nearly straight
  EXPECT_EQ(strengths.shown({&fill, 0.0}).s, 0.0);
  // Not better, because regions on the border of sight come and go.
  const Shown asked = strengths.sized(fill, 6.0, -1.0);
  EXPECT_NEAR(asked.s, 6.0, 0.9);
  EXPECT_LT(asked.active.departure, 0.0);
}

TEST_F(BlindStrength, WhatAllSetsShareIsWhatEachWouldSee) {
  const Strengths strengths = of("one_distance");
  const Hidden& fill = hidden_effect("fill_offset");
  const double next_to_typical = fill.typical * (1.0 + 1e-12);  // seen anew; moves no dot by more than rounding
  EXPECT_NEAR(strengths.shown({&fill, fill.typical}).s / strengths.shown({&fill, next_to_typical}).s, 1.0, 1e-6);
}

TEST_F(BlindStrength, OfWhatIsUncertainAnywayIsAtMostItsPrior) {
  const Strengths strengths = of("one_distance");
  // A departure of one prior σ has s < 1, whatever the data: s² = x² / (σ² + …).
  EXPECT_LT(strengths.shown({&hidden_effect("baseline"), 0.05}).s, 1.0);
  EXPECT_LT(strengths.shown({&hidden_effect("sensor_height"), 0.5}).s, 1.0);
  // So at any size: of dots that fall into other windows nothing may be left. A tenth: refraction is not quite linear.
  EXPECT_LT(strengths.shown({&hidden_effect("sensor_pitch"), 0.2}).s, 1.1 * 0.2 / 0.05);
  EXPECT_LT(strengths.shown({&hidden_effect("baseline"), -0.7}).s, 1.1 * 0.7 / 0.05);
  // Nobody wrote down albedos: −0.2 of 0.7 are 0.34 in the logarithm, of a prior of 0.3. Twice that: blocks that see
  // wall and bottom at once go with the brighter.
  EXPECT_LT(strengths.shown({&hidden_effect("wall_albedo"), -0.2}).s, 2.0 * 0.34 / 0.3);
}

TEST_F(BlindStrength, DirtAndSwayBeginAfterTheFirstSession) {
  const Strengths one_session = of("few_pours"), three_sessions = of("full");
  for (const char* name : {"dirty_lens", "rolling_exposure"}) {
    const Hidden& effect = hidden_effect(name);
    EXPECT_EQ(one_session.shown({&effect, effect.typical}).s, 0.0) << name;
    EXPECT_GT(three_sessions.shown({&effect, effect.typical}).s, 3.0) << name;
  }
}

TEST_F(BlindStrength, WhatAUnitsBiasMayBeIsNoStrength) {
  static const Hidden bias{
      "unit", "px", 0, 0.1, -1, 1, false, [](World& world, const Placement&, double px) {
                             world.unit[10] += px; }};
  const double sigma = unit_sigmas()[10];
  EXPECT_LT(of("heights_only").shown({&bias, sigma}).s, 1.0);
  // Clouds show the desk, so that a third of it is left.
  const double s = of("full").shown({&bias, sigma}).s;
  EXPECT_GT(s, 1.0);
  EXPECT_LT(s, 1.0 / kLeftOfUnit);
}

TEST_F(BlindStrength, AliasedEffectsDoNotEscapeEachOther) {
  const Strengths strengths = of("opaque_only");
  const Hidden* bottom = &hidden_effect("cup_bottom_height");
  const Active fill{&hidden_effect("fill_offset"), bottom->typical};
  const Eigen::MatrixXd sensitivity = strengths.sensitivity(std::span(&fill, 1));
  EXPECT_GT(sensitivity.norm(), 3.0);
  // Both raise an opaque surface; the tenth that is left is the wetted wall's and the prior of the bottom's.
  EXPECT_LT(strengths.escape(sensitivity, std::span(&bottom, 1)), 0.15 * Strengths::common_norm(sensitivity));
}

}  // namespace
}  // namespace fathom::blind
