// What `fathom campaign` promises: a measurement directory, the same for the same spec and seed, that can be resumed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/files.h"
#include "core/json.h"
#include "core/table.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace campaign_test {

namespace fs = std::filesystem;

// Geometric captures: a tenth of a second each.
const Json kSpec = Json::parse(R"({
  "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 400, 0]},
  "cup": {"shape": "paper_cup"},
  "liquids": {"water": "water"},
  "fillings": [{"liquid": "empty"}, {"liquid": "water", "fill_mm": 30}],
  "distance_mm": [300, 400], "trials": 2, "mode": "geometric"})");

struct CampaignCommand : testing::Test {
  TemporaryFolder folder;

  ProgramRun campaign(const Json& spec, const std::string& name, const std::string& options = "") {
    write_json(folder / "spec.json", spec);
    return run_fathom("campaign " + (folder / "spec.json").string() + " -o " + (folder / name).string() + " " +
                      options);
  }
  std::string error_of(const Json& spec) {
    const ProgramRun run = campaign(spec, "bad");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
    EXPECT_FALSE(fs::exists(folder / "bad"));
    const std::string file = "error: " + (folder / "spec.json").string() + ": ";
    return run.err.starts_with(file) ? run.err.substr(file.size()) : run.err;
  }
};

TEST_F(CampaignCommand, WritesWhatMeasureReads) {
  ASSERT_EQ(campaign(kSpec, "out").exit_code, 0);
  ASSERT_EQ(run_fathom("measure " + (folder / "out").string()).exit_code, 0);
  const Table heights = read_table(folder / "out" / "heights.csv");
  ASSERT_EQ(heights.rows(), 8u);
  // The bottom at 7 mm, to the steps of the depth (1 mm) over some hundred points; 30 mm of water raise it by 8.4 mm at
  // 300 mm and 9.2 mm at 400 mm, by 0.3 mm more or less for a filling that is off by its sigma of 0.5 mm (2 sigma
  // here).
  const double expected[] = {7.0, 7.0, 7.0, 7.0, 15.4, 15.4, 16.2, 16.2};
  for (std::size_t row = 0; row < heights.rows(); ++row)
    EXPECT_NEAR(heights.number(row, "height_mm"), expected[row], row < 4 ? 0.3 : 0.8) << row;
}

TEST_F(CampaignCommand, TheRigHasTheFocalLengthAt640ColumnsAndACupBelowTheSensorIsInSight) {
  Json spec = kSpec;
  spec["sensor"] = {{"model", "xtion_pro_live"},   {"height_mm", 650},
                    {"aim_mm", {0, 0, 0}},         {"ir_size_px", {640, 512}},
                    {"depth_size_px", {320, 240}}, {"focal_px", 285.0}};
  spec["distance_mm"] = {0};
  const ProgramRun run = campaign(spec, "out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_DOUBLE_EQ(read_json(folder / "out/rig.json")["sensor"]["focal_px"].get<double>(), 570.0);
}

TEST_F(CampaignCommand, TheRigSaysHowTheSensorStandsAndHowWideTheCupIsAtOneHeight) {
  Json spec = kSpec;
  spec["sensor"] = {{"model", "xtion_pro_live"}, {"height_mm", 650}, {"pitch_deg", 58.4}, {"roll_deg", 5}};
  spec["cup"] = {{"shape", "tapered_cup"}};
  spec["fillings"] = {{{"liquid", "empty"}}};
  spec["distance_mm"] = {400};
  spec["trials"] = 1;
  ASSERT_EQ(campaign(spec, "out").exit_code, 0);
  const Json rig = read_json(folder / "out" / "rig.json");
  constexpr double kTidied = 1e-6;  // the file's last decimal
  EXPECT_NEAR(rig["sensor"]["pitch_deg"].get<double>(), 58.4, kTidied);
  EXPECT_NEAR(rig["sensor"]["roll_deg"].get<double>(), 5.0, kTidied);
  // Straight walls: inside from 26 mm at 4 mm to 38 mm at 90 mm, outside from 27 mm on the desk to 39 mm; at 45 mm.
  EXPECT_NEAR(rig["cup"]["inner_radius_mm"].get<double>(), 26.0 + 12.0 * 41.0 / 86.0, kTidied);
  EXPECT_NEAR(rig["cup"]["outer_radius_mm"].get<double>(), 27.0 + 12.0 * 45.0 / 90.0, kTidied);
}

TEST_F(CampaignCommand, EqualSeedsGiveEqualFilesOthersDoNot) {
  const std::string truth = "--truth " + (folder / "truth_").string();
  ASSERT_EQ(campaign(kSpec, "a", truth + "a.json").exit_code, 0);
  ASSERT_EQ(campaign(kSpec, "b", truth + "b.json --threads 1").exit_code, 0);
  ASSERT_EQ(campaign(kSpec, "c", truth + "c.json --seed 2").exit_code, 0);
  for (const char* file : {"rig.json", "frames.csv", "clouds/000000.pcd", "clouds/000007.pcd"})
    EXPECT_EQ(read_text(folder / "a" / file), read_text(folder / "b" / file)) << file;
  EXPECT_EQ(read_text(folder / "truth_a.json"), read_text(folder / "truth_b.json"));
  EXPECT_NE(read_text(folder / "truth_a.json"), read_text(folder / "truth_c.json"));
}

TEST_F(CampaignCommand, TheTruthStaysOutOfTheFolder) {
  ASSERT_EQ(campaign(kSpec, "out", "--truth " + (folder / "new" / "truth.json").string()).exit_code, 0);
  const Json truth = read_json(folder / "new" / "truth.json");
  ASSERT_EQ(truth["placements"].size(), 4u);
  const double fill_mm = truth["placements"][2]["fill_mm"];
  EXPECT_NE(fill_mm, 30.0);
  EXPECT_LT(std::abs(fill_mm - 30.0), 2.5);               // 5 sigma
  EXPECT_EQ(fill_mm, truth["placements"][3]["fill_mm"]);  // one pour
  EXPECT_EQ(truth["placements"][0]["fill_mm"], 0.0);
  EXPECT_EQ(read_table(folder / "out" / "frames.csv").text(4, "fill_mm"), "30");
}

TEST_F(CampaignCommand, ATruthThatCannotBeWrittenLeavesNoFolder) {
  const ProgramRun inside = campaign(kSpec, "out", "--truth " + (folder / "out" / "truth.json").string());
  EXPECT_EQ(inside.exit_code, 2);
  EXPECT_EQ(inside.err.rfind("error: --truth must lie outside the folder of -o", 0), 0u) << inside.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_EQ(campaign(kSpec, "out", "--truth " + (folder / "spec.json" / "truth.json").string()).exit_code, 1);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(CampaignCommand, ARunThatWasCutShortBeforeItsFirstCloudGoesOn) {
  ASSERT_EQ(campaign(kSpec, "out").exit_code, 0);
  for (const char* later : {"clouds", "rig.json", "frames.csv"}) fs::remove_all(folder / "out" / later);
  ASSERT_EQ(campaign(kSpec, "out").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "out" / "clouds/000007.pcd"));
}

TEST_F(CampaignCommand, ARunThatWasCutShortGoesOn) {
  ASSERT_EQ(campaign(kSpec, "out").exit_code, 0);
  const std::string cloud = read_text(folder / "out" / "clouds/000003.pcd");
  fs::remove(folder / "out" / "clouds/000003.pcd");
  fs::remove(folder / "out" / "frames.csv");
  const ProgramRun again = campaign(kSpec, "out", "--json");
  ASSERT_EQ(again.exit_code, 0);
  EXPECT_EQ(Json::parse(again.out)["frames_shot_now"]["value"], 1.0);
  EXPECT_EQ(read_text(folder / "out" / "clouds/000003.pcd"), cloud);
  EXPECT_TRUE(fs::exists(folder / "out" / "frames.csv"));
}

TEST_F(CampaignCommand, KeepsInfraredImagesWhereItIsAskedTo) {
  Json spec = kSpec;
  spec.update({{"mode", "photometric"}, {"distance_mm", {300}}, {"trials", 1}});
  ASSERT_EQ(campaign(spec, "out", "--infrared --spp 1").exit_code, 0);
  EXPECT_EQ(read_table(folder / "out" / "frames.csv").text(1, "ir"), "infrared/000001.png");
  const fs::path image = folder / "out" / "infrared/000001.png";
  const std::string whole = read_text(image);
  fs::remove(image);
  EXPECT_EQ(Json::parse(campaign(spec, "out", "--infrared --spp 1 --json").out)["frames_shot_now"]["value"], 1.0);
  EXPECT_EQ(read_text(image), whole);
  EXPECT_EQ(run_fathom("measure " + (folder / "out").string()).exit_code, 0);
  EXPECT_EQ(campaign(kSpec, "geometric", "--infrared").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "geometric"));
}

TEST_F(CampaignCommand, ACloudThatIsNotWholeIsShotAgain) {
  ASSERT_EQ(campaign(kSpec, "out").exit_code, 0);
  const fs::path file = folder / "out" / "clouds/000003.pcd";
  const std::string cloud = read_text(file);
  std::string overwritten = cloud;
  overwritten.back() ^= 1;  // of the same size, by another program
  for (const std::string& damaged : {cloud.substr(0, cloud.size() / 2), cloud + "more", std::string(), overwritten}) {
    write_text(file, damaged);
    EXPECT_EQ(Json::parse(campaign(kSpec, "out", "--json").out)["frames_shot_now"]["value"], 1.0);
    EXPECT_EQ(read_text(file), cloud);
  }
}

TEST_F(CampaignCommand, AFolderHoldsOneCampaign) {
  ASSERT_EQ(campaign(kSpec, "out").exit_code, 0);
  Json other = kSpec;
  other["trials"] = 3;
  const ProgramRun run = campaign(other, "out", "--truth " + (folder / "truth.json").string());
  EXPECT_FALSE(fs::exists(folder / "truth.json"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err, "error: " + (folder / "out" / "manifest.jsonl").string() + ": is of another run: " +
                         (folder / "spec.json").string() + " has changed; choose another folder\n");
  EXPECT_FALSE(fs::exists(folder / "out" / "clouds/000008.pcd"));
}

TEST_F(CampaignCommand, CloudsOfAnotherCupAreNeverMixedIn) {
  // A library of one's own, in which the cup changes between two runs, as between two versions of the program.
  const fs::path library = folder / "scenes";
  fs::copy(data_directory(), library, fs::copy_options::recursive);
  const auto run = [&](const std::string& options) {
    write_json(folder / "spec.json", kSpec);
    return run_fathom(
        fmt::format("campaign {} -o {} {}", (folder / "spec.json").string(), (folder / "out").string(), options),
        "FATHOM_DATA=" + library.string());
  };
  ASSERT_EQ(run("").exit_code, 0);
  fs::remove(folder / "out" / "clouds/000003.pcd");
  for (const char* file : {"cups/paper_cup.json", "media/water.json", "sensors/xtion_pro_live.json"}) {
    const std::string text = read_text(library / file);
    write_text(library / file, text + "\n");
    const ProgramRun again = run("");
    EXPECT_EQ(again.exit_code, 1) << file;
    EXPECT_EQ(again.err, fmt::format("error: {}: is of another run: {} has changed; choose another folder\n",
                                     (folder / "out/manifest.jsonl").string(), (library / file).string()));
    EXPECT_FALSE(fs::exists(folder / "out" / "clouds/000003.pcd"));
    write_text(library / file, text);
  }
  EXPECT_NE(run("--seed 2").err.find("seed was 1, is 2"), std::string::npos);
  EXPECT_EQ(run("").exit_code, 0);
}

TEST_F(CampaignCommand, TheFolderNamesNothingThatIsHidden) {
  Json spec = kSpec;
  spec.update({{"distance_mm", {300}}, {"trials", 1}});
  spec["effects"] = {{{"name", "wrong_cup"}, {"scale", 0.9}}, {{"name", "cup_bottom_height"}, {"height_mm", 5.4321}}};
  ASSERT_EQ(campaign(spec, "out", "--truth " + (folder / "truth.json").string()).exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
    if (!entry.is_regular_file()) continue;
    const std::string text = read_text(entry.path());
    for (const char* hidden : {"wrong_cup", "cup_bottom_height", "5.4321"})
      EXPECT_EQ(text.find(hidden), std::string::npos) << entry.path() << " names " << hidden;
  }
}

TEST_F(CampaignCommand, RunsInOneFolderAtOnceLeaveTheResultOfOne) {
  ASSERT_EQ(campaign(kSpec, "alone").exit_code, 0);
  const std::string command =
      fmt::format("campaign {} -o {} --quiet", (folder / "spec.json").string(), (folder / "out").string());
  int done = 0;
  for (const ProgramRun& run : run_fathom_at_once(command, 3)) {
    done += run.exit_code == 0;  // more than one where one began after another's end
    if (run.exit_code == 0) continue;
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("is being written by "), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_GE(done, 1);
  for (const char* file : {"manifest.jsonl", "frames.csv", "clouds/000007.pcd"})
    EXPECT_EQ(read_text(folder / "out" / file), read_text(folder / "alone" / file)) << file;
}

TEST_F(CampaignCommand, SessionsBeginWithTheBareDeskAndTheirTimeAtZero) {
  Json spec = kSpec;
  spec.update({{"sessions", 2}, {"bare_desk_views", 1}, {"distance_mm", {300}}, {"trials", 1}});
  spec.update({{"frame_s", 2}, {"placement_s", 10}, {"pour_s", 60}});
  ASSERT_EQ(campaign(spec, "out").exit_code, 0);
  const Table frames = read_table(folder / "out" / "frames.csv");
  const struct {
    const char *session, *pour, *placement, *time_s, *liquid;
  } expected[] = {{"0", "0", "0", "0", "none"}, {"0", "0", "0", "72", "empty"}, {"0", "1", "1", "144", "water"},
                  {"1", "0", "0", "0", "none"}, {"1", "2", "2", "72", "empty"}, {"1", "3", "3", "144", "water"}};
  ASSERT_EQ(frames.rows(), std::size(expected));
  for (std::size_t row = 0; row < frames.rows(); ++row) {
    EXPECT_EQ(frames.text(row, "frame"), std::to_string(row));
    EXPECT_EQ(frames.text(row, "session"), expected[row].session) << row;
    EXPECT_EQ(frames.text(row, "pour"), expected[row].pour) << row;
    EXPECT_EQ(frames.text(row, "placement"), expected[row].placement) << row;
    EXPECT_EQ(frames.text(row, "time_s"), expected[row].time_s) << row;
    EXPECT_EQ(frames.text(row, "liquid"), expected[row].liquid) << row;
  }
  EXPECT_EQ(run_fathom("measure " + (folder / "out").string()).exit_code, 0);
}

TEST_F(CampaignCommand, EveryPourEvaporatesFromItsOwnBeginning) {
  Json spec = kSpec;
  spec["liquids"] = {{"milk", {{"index", 1.336}, {"scattering_per_mm", 1000}}}};
  spec["fillings"] = {{{"liquid", "milk"}, {"fill_mm", 30}}};
  spec.update({{"distance_mm", {300}}, {"trials", 1}, {"pours", 2}, {"pour_s", 3600}, {"placement_s", 72}});
  ASSERT_EQ(campaign(spec, "plain").exit_code, 0);
  spec["effects"] = {{{"name", "evaporation"}, {"rate_mm_per_h", 50}}};
  ASSERT_EQ(campaign(spec, "dry").exit_code, 0);
  const auto heights_of = [&](const char* name) {
    EXPECT_EQ(run_fathom("measure " + (folder / name).string()).exit_code, 0);
    return read_table(folder / name / "heights.csv");
  };
  const Table plain = heights_of("plain"), dry = heights_of("dry");
  ASSERT_EQ(dry.rows(), 2u);
  // 72 s of 50 mm an hour; steps of the depth, 1 mm, over some hundred points.
  for (std::size_t pour = 0; pour < 2; ++pour)
    EXPECT_NEAR(dry.number(pour, "height_mm") - plain.number(pour, "height_mm"), -1.0, 0.3) << pour;
}

TEST_F(CampaignCommand, EffectsAreInTheCloudsAndTheTruthAlone) {
  Json spec = kSpec;
  spec.update({{"distance_mm", {300}}, {"trials", 1}, {"fillings", {{{"liquid", "empty"}}}}});
  ASSERT_EQ(campaign(spec, "plain").exit_code, 0);
  spec["effects"] = {{{"name", "cup_bottom_height"}, {"height_mm", 5}}};
  spec["rig_sigma"] = {{"height_mm", 0.5}};
  const std::string model = (folder / "model.json").string(), truth = (folder / "truth.json").string();
  write_json(model, {{"effects", {{{"name", "cup_bottom_height"}, {"height_mm", 3}}}}});
  ASSERT_EQ(campaign(spec, "raised", "--model " + model + " --truth " + truth).exit_code, 0);
  const auto height_mm = [&](const char* name) {
    EXPECT_EQ(run_fathom("measure " + (folder / name).string()).exit_code, 0);
    return read_table(folder / name / "heights.csv").number(0, "height_mm");
  };
  EXPECT_NEAR(height_mm("raised") - height_mm("plain"), 8.0, 0.4);  // steps of the depth, over some hundred points
  EXPECT_EQ(read_json(truth)["effects"].size(), 3u);  // that of the spec, the model's, the sensor's height
  const Json rig = read_json(folder / "raised" / "rig.json");
  EXPECT_EQ(rig["sensor"]["sigma"]["height_mm"], 0.5);
  EXPECT_EQ(rig["cup"], read_json(folder / "plain" / "rig.json")["cup"]);
}

TEST_F(CampaignCommand, ItsSchemaHasTheKeysOfItsReader) {
  const std::string error = error_of(Json{{"no_such_key", 0}});
  std::string keys;
  const Json schema = read_json(data_directory() / "campaigns" / "schema.json");
  for (const auto& [key, value] : schema["properties"].items()) keys += (keys.empty() ? "" : ", ") + key;
  EXPECT_EQ(error, "/no_such_key: unknown key 'no_such_key', choose from " + keys + "\n");
}

TEST_F(CampaignCommand, ALiquidIsCalledWhateverMeasureReadsBack) {
  Json spec = kSpec;
  spec["distance_mm"] = {300};
  spec["trials"] = 1;
  const auto named = [&](const std::string& name) {
    spec["liquids"] = {{name, "water"}};
    spec["fillings"] = {{{"liquid", name}, {"fill_mm", 30}}};
    return spec;
  };
  ASSERT_EQ(campaign(named("tea, \"iced\""), "out").exit_code, 0);
  EXPECT_EQ(run_fathom("measure " + (folder / "out").string()).exit_code, 0);
  EXPECT_EQ(read_table(folder / "out" / "heights.csv").text(0, "liquid"), "tea, \"iced\"");
  for (const std::string& name : {std::string(" water"), std::string("water\t"), std::string("a\rb"),
                                  std::string("a\nb"), std::string("a\0b", 3)})
    EXPECT_NE(error_of(named(name))
                  .find("must be a name that frames.csv can hold: no line break, no NUL, no blank at its ends\n"),
              std::string::npos)
        << name;
}

TEST_F(CampaignCommand, MistakesNameFileAndKey) {
  const auto with = [](const std::string& pointer, const Json& value) {
    Json spec = kSpec;
    spec[Json::json_pointer(pointer)] = value;
    return spec;
  };
  EXPECT_EQ(error_of(with("/trails", 3)).rfind("/trails: ", 0), 0u);
  EXPECT_EQ(
      error_of(with("/distance_mm", {30, 40})),
      "/distance_mm: must be in mm and, with lateral_mm 0, where the sensor, 650 mm high and pitched down by 58.39 "
      "degrees, sees the cup, got 30\n");
  EXPECT_EQ(error_of(with("/sensor/baseline_mm", 5)).rfind("its rig.json: /sensor/baseline_mm: ", 0), 0u);
  EXPECT_EQ(error_of(with("/trials", 0)).rfind("/trials: must be ", 0), 0u);
  EXPECT_EQ(error_of(with("/fillings/1/liquid", "wtaer")),
            "/fillings/1/liquid: unknown liquid 'wtaer', choose from empty, water; did you mean 'water'?\n");
  EXPECT_EQ(error_of(with("/fillings/1/fill_mm", 81)),
            "/fillings/1/fill_mm: must be at most 80, the depth of the cup\n");
  EXPECT_EQ(error_of(with("/fillings/0/fill_mm", 5)), "/fillings/0/fill_mm: cannot stand beside \"empty\"\n");
  EXPECT_EQ(error_of(with("/distance_mm", {300, 1e9})),
            "/distance_mm/1: must be a place on the desk, from 0 to 1000, got 1000000000.0\n");
  EXPECT_EQ(error_of(with("/lateral_mm", {-701})),
            "/lateral_mm/0: must be a place on the desk, from -700 to 700, got -701\n");
  EXPECT_EQ(error_of(with("/fill_sigma_mm", 1e9)), "/fill_sigma_mm: must be a number from 0 to 80, got 1000000000.0\n");
  EXPECT_EQ(error_of(with("/placement_sigma_mm", 44)), "/placement_sigma_mm: must be a number from 0 to 43, got 44\n");
  EXPECT_EQ(error_of(with("/sensor", {{"height_mm", 650}, {"pitch_deg", 58}})),
            "/sensor/model: is missing: a measurement's rig names its sensor, choose from kinect_v1, kinect_v1_device, "
            "xtion_pro_live, xtion_pro_live_device; other keys change it\n");
  EXPECT_EQ(error_of(with("/sensor/wavelength_nm", 2000)),
            "/liquids/water: the index of water is known from 200 to 1100 nm, the sensor works at 2000 nm\n");
  EXPECT_EQ(error_of(with("/distance_mm", Json::array())), "/distance_mm: must hold at least one length\n");
  EXPECT_EQ(error_of(with("/sensor/aim_mm", {50, 400, 0})),
            "/sensor/aim_mm: must lie straight ahead (x = 0, y ≥ 0): a measurement's rig knows no yaw\n");
  EXPECT_EQ(error_of(with("/effects", {{{"name", "foma"}}})).rfind("/effects/0/name: unknown effect 'foma', ", 0), 0u);
  EXPECT_EQ(error_of(with("/liquids/empty", "water")), "/liquids/empty: is a reserved name and no liquid\n");
}

TEST_F(CampaignCommand, SaysHowMuchItIsGoingToWrite) {
  const ProgramRun run = campaign(kSpec, "out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  // 8 clouds of 640 × 480 points of 16 bytes.
  EXPECT_TRUE(run.err.starts_with((folder / "out").string() + ": 8 frames are up to 39.4 MB, of which 39.4 MB are "
                                                              "still to be written; the disk has "))
      << run.err;
  const ProgramRun again = campaign(kSpec, "out");
  EXPECT_NE(again.err.find("of which 0 bytes are"), std::string::npos) << again.err;
  EXPECT_EQ(campaign(kSpec, "quiet", "--quiet").err, "");
}

TEST_F(CampaignCommand, AsksBeforeItWritesMoreThanTwentyGigabytes) {
  Json spec = kSpec;
  spec["trials"] = 1100;  // 4400 frames: 21.6 GB
  const ProgramRun asked = campaign(spec, "large");
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_TRUE(asked.err.starts_with("error: 4400 frames are up to 21.6 GB")) << asked.err;
  EXPECT_NE(asked.err.find("20 GB are written only with --yes"), std::string::npos) << asked.err;
  EXPECT_FALSE(fs::exists(folder / "large"));
  // No disk has as much; nor could the plan of it be held in memory.
  for (const char* key : {"sessions", "pours", "placements", "trials"}) spec[key] = 10000;
  EXPECT_EQ(campaign(spec, "endless").exit_code, 2);
  const ProgramRun endless = campaign(spec, "endless", "--yes --truth " + (folder / "truth.json").string());
  EXPECT_EQ(endless.exit_code, 1);
  EXPECT_NE(endless.err.find("choose a larger disk or fewer frames"), std::string::npos) << endless.err;
  EXPECT_FALSE(fs::exists(folder / "endless"));
  EXPECT_FALSE(fs::exists(folder / "truth.json"));
}

}  // namespace campaign_test
}  // namespace fathom
