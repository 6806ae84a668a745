// What `fathom detect` and `fathom template` promise on the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "core/cloud_file.h"
#include "core/files.h"
#include "core/json.h"
#include "tests/app/run_fathom.h"
#include "tests/detector/synthetic.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// A folder with the clouds of an empty and a filled cup, a template of the first and a configuration that names it.
struct DetectCommand : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  std::string empty = (folder / "empty.pcd").string(), filled = (folder / "filled.pcd").string();
  std::string config = (folder / "config.json").string();

  void SetUp() override {
    make_directory(folder);
    synthetic::write_cup(empty, 0.007);
    synthetic::write_cup(filled, 0.027);
    const ProgramRun made = run_fathom("template " + empty + " -o " + folder.string() + " --name paper_cup");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    write_text(config, R"({"templates": ["paper_cup.json"]})");
  }
  void TearDown() override { fs::remove_all(folder); }
};

TEST_F(DetectCommand, JsonHasTheKeysThatOthersRelyOn) {
  const ProgramRun run =
      run_fathom("detect " + filled + " --json --config " + config + " --height-mm 650 --pitch-deg 58.4");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json.at("segments"), 1);
  EXPECT_NEAR(json.at("plane").at("height_mm").get<double>(), 650.0, 0.1);
  EXPECT_NEAR(json.at("plane").at("pitch_deg").get<double>(), 58.392, 0.01);  // atan(650 / 400)
  EXPECT_EQ(json.at("plane").at("normal").size(), 3u);
  for (const char* key : {"inliers", "rms_mm", "offset_m"}) EXPECT_TRUE(json.at("plane").contains(key)) << key;
  ASSERT_EQ(json.at("cups").size(), 1u);
  const Json& cup = json.at("cups")[0];
  EXPECT_EQ(cup.at("center_camera_m").size(), 3u);
  EXPECT_NEAR(cup.at("radius_mm").get<double>(), 41.5, 0.5);
  EXPECT_EQ(cup.at("liquid"), "yes");
  EXPECT_NEAR(cup.at("surface_mm").get<double>(), 27.0, 0.1);
  EXPECT_EQ(cup.at("kind"), "unknown");
  EXPECT_TRUE(cup.at("fill_mm").is_null());
  EXPECT_TRUE(cup.at("fill_sigma_mm").is_null());
  for (const char* key : {"score", "sigma_mm", "why"}) EXPECT_TRUE(cup.contains(key)) << key;
}

TEST_F(DetectCommand, ACloudThatCannotBeReadCostsNoneBeforeIt) {
  const ProgramRun run = run_fathom("detect " + empty + " " + (folder / "missing.pcd").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.out.rfind("cloud ", 0), 0u) << run.out;
  EXPECT_NE(run.out.find("\ncups "), std::string::npos) << run.out;
}

TEST_F(DetectCommand, RowsAreNameValueUnit) {
  const ProgramRun run = run_fathom("detect " + filled + " --config " + config + " -o " + (folder / "kept").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::map<std::string, std::pair<std::string, std::string>> rows;  // name → value, unit
  std::istringstream lines(run.out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    words >> rows[name].first >> rows[name].second;
  }
  EXPECT_EQ(rows.at("cloud").first, filled);
  EXPECT_NEAR(std::stod(rows.at("desk_height").first), 650.0, 0.1);
  EXPECT_EQ(rows.at("desk_height").second, "mm");
  EXPECT_EQ(rows.at("cups").first, "1");
  EXPECT_EQ(rows.at("cup0_liquid").first, "yes");
  EXPECT_NEAR(std::stod(rows.at("cup0_surface").first), 27.0, 0.1);
  EXPECT_EQ(rows.at("cup0_center_z").second, "m");
  EXPECT_EQ(read_text(folder / "kept" / "detection.txt"), run.out);
}

TEST_F(DetectCommand, AFolderKeepsWhatWasFoundAndTheCloudsOfIt) {
  const fs::path kept = folder / "kept";
  const auto detect = [&](const std::string& arguments) {
    const ProgramRun run = run_fathom("detect " + arguments + " --config " + config + " -o " + kept.string());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  const std::string rows = detect(empty + " " + filled);
  EXPECT_EQ(read_text(kept / "detection.txt"), rows);
  const Json both = read_json(kept / "detection.json");
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[1].at("cloud"), filled);
  // What was kept is what was searched, also where it is searched in its own folder.
  EXPECT_EQ(Json::parse(detect((kept / "detection_0001.pcd").string() + " --json")).at("cups"), both[1].at("cups"));
  EXPECT_TRUE(fs::exists(kept / "detection_0000.pcd"));
  for (const char* older : {"detection.txt", "detection_0001.pcd"}) EXPECT_FALSE(fs::exists(kept / older)) << older;
  detect(empty + " " + filled + " --keep-clouds 0");
  EXPECT_FALSE(fs::exists(kept / "detection_0000.pcd"));
}

TEST_F(DetectCommand, TellsHowMuchRoomThereIsToWhatItFinds) {
  const Json found = Json::parse(run_fathom("detect " + filled + " --json --config " + config).out);
  EXPECT_NEAR(found.at("cups")[0].at("height_mm").get<double>(), 87.0, 1.0);
  EXPECT_NEAR(found.at("cups")[0].at("lean_deg").get<double>(), 0.0, 1.0);
  write_text(config, R"({"templates": ["paper_cup.json"], "robust": {"radius_mm": [20, 30]}})");
  const Json none = Json::parse(run_fathom("detect " + filled + " --json --config " + config).out);
  const Json& candidate = none.at("candidates").at(0);
  EXPECT_NEAR(candidate.at("height_mm").get<double>(), 87.0, 1.0);
  EXPECT_NEAR(candidate.at("width_mm").get<double>(), 83.0, 3.0);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(candidate.at("center_camera_m")[axis].get<double>(),
                found.at("cups")[0].at("center_camera_m")[axis].get<double>(), 0.003);
}

TEST_F(DetectCommand, ATemplateOfASimulatedCupThatIsNotEmptyIsRefused) {
  write_text(folder / "run.json", R"({"scene": {"cups": [{"shape": "paper_cup", "liquid": "water", "fill_mm": 30}]}})");
  const ProgramRun run = run_fathom("template " + filled + " --name full -o " + folder.string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err, "error: " + (folder / "run.json").string() + ": /scene/cups/0/liquid: the cup of " + filled +
                         " holds a liquid, a template needs an empty one\n");
  EXPECT_FALSE(fs::exists(folder / "full.json"));
}

TEST_F(DetectCommand, ATemplateNeedsAFolder) {
  EXPECT_EQ(run_fathom("template " + empty + " --name paper_cup").exit_code, 2);
}

TEST_F(DetectCommand, SeveralCloudsGiveAListInTheirOrder) {
  const ProgramRun run = run_fathom("detect " + empty + " " + filled + " --json --config " + config);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out);
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0].at("cloud"), empty);
  EXPECT_EQ(json[0].at("cups").at(0).at("liquid"), "no");
  EXPECT_EQ(json[1].at("cloud"), filled);
  EXPECT_EQ(json[1].at("cups").at(0).at("liquid"), "yes");
}

TEST_F(DetectCommand, TheTemplateThatComesWithTheProgramIsThePaperCup) {
  const ProgramRun run = run_fathom("detect " + empty);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("matches paper_cup"), std::string::npos) << run.out;
  const ProgramRun paper = run_fathom("detect " + empty + " --method paper");
  EXPECT_NE(paper.out.find("matches paper_cup; mean height inside 7.0 mm is not above its threshold of 9 mm"),
            std::string::npos)
      << paper.out;
}

TEST_F(DetectCommand, AGapInTheRulesOfUseIsBadUsage) {
  const ProgramRun method = run_fathom("detect " + empty + " --method papre");
  EXPECT_EQ(method.exit_code, 2);
  EXPECT_NE((method.out + method.err).find("unknown method 'papre', choose from robust, paper, sac-ia, prerejective"),
            std::string::npos)
      << method.err;
  EXPECT_EQ(run_fathom("detect").exit_code, 2);
  EXPECT_EQ(run_fathom("detect " + empty + " --height-mm 650").exit_code, 2);
  EXPECT_EQ(run_fathom("template " + empty + " -o " + folder.string() + " --name a/b").exit_code, 2);
  const ProgramRun no_number = run_fathom("detect " + empty + " --height-mm nan --pitch-deg 58");
  EXPECT_EQ(no_number.exit_code, 2);
  EXPECT_EQ(no_number.err.rfind("error: --height-mm: must be a number from 1 to 100000, got 'nan'\n", 0), 0u)
      << no_number.err;
  const ProgramRun none =
      run_fathom("template " + empty + " -o " + folder.string() + " --name a --liquid-threshold-mm 0");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err.rfind("error: --liquid-threshold-mm: must be a number above 0, got '0'\n", 0), 0u) << none.err;
}

TEST_F(DetectCommand, ViewsWithPosesAreOneDetection) {
  const std::string pose = "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]", poses = (folder / "poses.json").string();
  write_text(poses, R"({"world_from_camera": [)" + pose + ", " + pose + "]}");
  const ProgramRun run = run_fathom("detect " + empty + " " + empty + " --json --poses " + poses);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_EQ(Json::parse(run.out).at("cups").size(), 1u);
  EXPECT_EQ(run_fathom("detect " + empty + " --poses " + poses).err,
            "error: " + poses + ": /world_from_camera: has 2 poses for 1 clouds\n");
  write_text(poses, R"({"world_from_camera": [[[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]]})");
  EXPECT_EQ(run_fathom("detect " + empty + " --poses " + poses).err,
            "error: " + poses +
                ": /world_from_camera/0: is no rotation: its rows must be orthogonal, of length 1 and "
                "right-handed\n");
  EXPECT_EQ(run_fathom("detect " + empty + " --method paper --poses " + poses).exit_code, 2);
}

TEST_F(DetectCommand, EveryKeyOfTheConfigurationReachesTheRobustMethod) {
  const auto answer = [&](const std::string& robust) {
    write_text(config, R"({"templates": ["paper_cup.json"], "robust": )" + robust + "}");
    return run_fathom("detect " + filled + " --json --config " + config).out;
  };
  const std::string defaults = answer("{}");
  EXPECT_EQ(answer(R"({"plane_threshold_mm": 10, "plane_share_min": 0.03, "prior_height_max_mm": 150, "reach_mm": 2000,
    "segment_points_min": 60, "wall_tolerance_mm": 3, "hypotheses": 300, "radius_mm": [20, 60], "height_mm": [40, 170],
    "radius_sigma_max_mm": 3, "lid_mm": 12, "lid_share_max": 0.1, "beyond_share_max": 0.1, "inside_points_min": 20,
    "interior_margin_mm": 10, "interior_points_min": 40, "bottom_mm": 6, "bottom_sigma_mm": 2, "index": 1.33,
    "liquid_prior": 0.5, "liquid_sure": 0.6, "kind_sure": 0.8})"),
            defaults);
  for (const auto& [change, reason] : std::initializer_list<std::pair<const char*, const char*>>{
           {R"({"radius_mm": [20, 30]})", "radius"},
           {R"({"height_mm": [90, 95]})", "height"},
           {R"({"lid_mm": 80})", "closed"},
           {R"({"inside_points_min": 100000})", "nothing shows"}}) {
    const std::string out = answer(change);
    EXPECT_EQ(Json::parse(out).at("candidates").at(0).at("reason").get<std::string>().find(reason), 0u) << out;
  }
}

TEST_F(DetectCommand, MistakesAreOneLineThatNamesTheFile) {
  const auto error = [&](const std::string& arguments) {
    const ProgramRun run = run_fathom(arguments);
    EXPECT_EQ(run.exit_code, 1) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    return run.err;
  };
  write_text(folder / "bad.pcd", "hello\n");
  const std::string bad = (folder / "bad.pcd").string();
  EXPECT_EQ(error("detect " + bad + " --config " + config), "error: " + bad + ": is neither PCD nor PLY\n");
  write_text(config, R"({"band_mm": [50, 40]})");
  EXPECT_EQ(error("detect " + empty + " --config " + config),
            "error: " + config + ": /band_mm: must be two rising lengths [low, high]\n");
  write_text(config, R"({"band": [40, 50]})");
  EXPECT_EQ(error("detect " + empty + " --config " + config)
                .find("error: " + config + ": /band: unknown key 'band', choose from"),
            0u);
}

TEST_F(DetectCommand, EveryKeyOfTheConfigurationReachesThePapersMethod) {
  write_text(config,
             R"({"plane_threshold_mm": 10, "planes_max": 6, "plane_share_min": 0.03, "plane_iterations_max": 1000,
    "prior_angle_max_deg": 20, "prior_height_max_mm": 150, "height_max_mm": 100, "cluster_distance_mm": 40,
    "cluster_points_min": 100, "width_mm": [30, 170], "top_min_mm": 40, "band_mm": [40, 50], "circle_rms_max_mm": 40,
    "radius_mm": [20, 60], "icp_score_max_mm": 10, "icp_iterations_max": 30, "interior_margin_mm": 10,
    "interior_points_min": 10, "templates": ["paper_cup.json"]})");
  EXPECT_EQ(
      run_fathom("detect " + filled + " --method paper --json --config " + config).out,
      (write_text(folder / "defaults.json", R"({"templates": ["paper_cup.json"]})"),
       run_fathom("detect " + filled + " --method paper --json --config " + (folder / "defaults.json").string()).out));
  for (const auto& [change, reason] :
       std::initializer_list<std::pair<const char*, const char*>>{{R"({"radius_mm": [20, 30]})", "radius"},
                                                                  {R"({"width_mm": [30, 60]})", "width"},
                                                                  {R"({"icp_score_max_mm": 0.01})", "mean distance"},
                                                                  {R"({"band_mm": [90, 95]})", "no circle"}}) {
    write_text(config, change);
    const ProgramRun run = run_fathom("detect " + filled + " --method paper --json --config " + config);
    EXPECT_EQ(Json::parse(run.out).at("candidates").at(0).at("reason").get<std::string>().find(reason), 0u) << run.out;
  }
}

}  // namespace
}  // namespace fathom
