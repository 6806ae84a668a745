// What `fathom diagnose` promises: silence where nothing is hidden, the name and size of what is, and a model that has
// it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/files.h"
#include "core/json.h"
#include "core/table.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

// Geometric captures with the device's noise: thirty milliseconds each. The paint shows its surface: with water alone
// more of it and more refraction look alike.
const Json kSpec = Json::parse(R"({
  "sensor": {"model": "xtion_pro_live", "noise": "device", "height_mm": 650, "aim_mm": [0, 300, 0]},
  "cup": {"shape": "paper_cup"}, 
  "liquids": {"water": "water", "paint": {"index": 1.336, "scattering_per_mm": 1000}},
  "fillings": [{"liquid": "empty"}, {"liquid": "water", "fill_mm": 20}, {"liquid": "water", "fill_mm": 40},
               {"liquid": "paint", "fill_mm": 30}],
  "distance_mm": [200, 300], "lateral_mm": [-80, 80], "bare_desk_views": 3, "pours": 3, "trials": 2,
  "mode": "geometric"})");

struct DiagnoseCommand : testing::Test {
  TemporaryFolder folder;

  std::string path(const std::string& name) const { return (folder / name).string(); }

  void measure(const Json& effects) {
    Json spec = kSpec;
    spec["effects"] = effects;
    write_json(folder / "spec.json", spec);
    ASSERT_EQ(run_fathom("campaign " + path("spec.json") + " -o " + path("campaign")).exit_code, 0);
  }

  Json diagnosis(const std::string& output, const std::string& options = "") {
    const ProgramRun run = run_fathom("diagnose " + path("campaign") + " " + options + " -o " + path(output));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read_json(folder / output / "report.json");
  }

  /// The effect is named with its size, and a model that has it leaves no gap.
  void expect_found(const std::string& effect, const std::string& parameter, double value) {
    measure({{{"name", effect}, {parameter, value}}});
    const Json found = diagnosis("out");
    ASSERT_EQ(found["verdict"], "named") << found["answer"];
    ASSERT_EQ(found["effects"].size(), 1u);
    EXPECT_EQ(found["effects"][0]["name"], effect);
    // Twice the 95 % interval: at these fixed seeds one draw; off by chance at one effect in ten thousand.
    const Json& interval = found["effects"][0]["parameters"][parameter]["ci95"];
    const double half = 0.5 * (interval[1].get<double>() - interval[0].get<double>());
    EXPECT_NEAR(found["effects"][0]["parameters"][parameter]["value"], value, 2.0 * half);
    EXPECT_LT(half, 0.25 * value);
    EXPECT_LT(found["gap"]["train"]["after_rms_mm"], found["gap"]["train"]["before_rms_mm"]);
    const Json rest = diagnosis("rest", "--model " + path("out/model.json"));
    EXPECT_EQ(rest["verdict"], "none") << rest["answer"];
  }
};

TEST_F(DiagnoseCommand, NamesNothingWhereNothingIsHidden) {
  measure(Json::array());
  const Json report = diagnosis("out");
  EXPECT_EQ(report["verdict"], "none") << report["answer"];
  EXPECT_TRUE(report["effects"].empty());
  EXPECT_TRUE(read_json(folder / "out" / "model.json")["effects"].empty());
  for (const char* file : {"report.html", "next.json", "residuals.csv", "heights.png", "map.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / file)) << file;
  diagnosis("again", "--threads 1");
  for (const char* file : {"report.json", "report.html", "model.json", "residuals.csv"})
    EXPECT_EQ(read_text(folder / "out" / file), read_text(folder / "again" / file)) << file;
}

TEST_F(DiagnoseCommand, SaysWhatItWasToldNotToLookForAndNothingElse) {
  measure(Json::array());
  const std::string words = "Not looked for", all = diagnosis("all")["notes"].dump();
  EXPECT_EQ(all.find(words), std::string::npos) << all;
  const std::string some = diagnosis("some", "--without foam")["notes"].dump();
  EXPECT_NE(some.find(words + ": foam."), std::string::npos) << some;
}

TEST_F(DiagnoseCommand, SpeaksOfNoHeightsInCupsWhoseWallsHideWhatIsInThem) {
  Json spec = kSpec;
  spec["sensor"]["aim_mm"] = {0, 550, 0};
  spec["distance_mm"] = {600};
  spec["fillings"] = {{{"liquid", "water"}, {"fill_mm", 10}}, {{"liquid", "water"}, {"fill_mm", 15}}};
  write_json(folder / "spec.json", spec);
  ASSERT_EQ(run_fathom("campaign " + path("spec.json") + " -o " + path("campaign")).exit_code, 0);
  const Json report = diagnosis("out");
  const std::string answer = report["answer"], words = "No height in a cup could be compared";
  EXPECT_NE(answer.find(words), std::string::npos) << answer;
  EXPECT_EQ(answer.find("the heights differ"), std::string::npos) << answer;
  EXPECT_NE(report["notes"].dump().find(words), std::string::npos) << report["notes"];
  EXPECT_EQ(read_text(folder / "out" / "report.html").find("heights in the cup"), std::string::npos);
}

TEST_F(DiagnoseCommand, FindsASensorThatIsTurned) { expect_found("sensor_roll", "roll_deg", 0.8); }

TEST_F(DiagnoseCommand, FindsCupsThatHoldMore) { expect_found("fill_scale", "scale", 0.15); }

bool is_in_set(const Json& report, const std::string& effect) {
  for (const Json& explanation : report["ambiguity_set"]) {
    if (explanation["effects"] == Json{effect}) return true;
    if (explanation.contains("indistinguishable"))
      for (const Json& twin : explanation["indistinguishable"])
        if (twin == Json{effect}) return true;
  }
  return false;
}

// A cup of milk shows its surface alone: a higher bottom and a fuller cup are one. An empty cup tells them apart.
TEST_F(DiagnoseCommand, SaysWhichMeasurementTellsTwinsApartAndThatOneDoes) {
  Json spec = kSpec;
  spec["liquids"] = {{"milk", {{"index", 1.344}, {"scattering_per_mm", 1000}}}};
  spec["fillings"] = {{{"liquid", "milk"}, {"fill_mm", 20}}, {{"liquid", "milk"}, {"fill_mm", 40}}};
  spec["bare_desk_views"] = 0;
  spec["effects"] = {{{"name", "cup_bottom_height"}, {"height_mm", 4}}};
  write_json(folder / "spec.json", spec);
  ASSERT_EQ(run_fathom("campaign " + path("spec.json") + " -o " + path("campaign") + " --truth " + path("truth.json"))
                .exit_code,
            0);
  const Json before = diagnosis("out");
  EXPECT_EQ(before["verdict"], "ambiguous") << before["answer"];
  ASSERT_TRUE(is_in_set(before, "cup_bottom_height") && is_in_set(before, "fill_offset")) << before["ambiguity_set"];
  std::string file;
  for (const Json& next : read_json(folder / "out" / "next.json"))
    if (next["settles"] && next["separates"] == Json{"cup_bottom_height", "fill_offset"}) file = next["campaign"];
  ASSERT_FALSE(file.empty()) << before["next"];

  Json next = read_json(folder / "out" / file);
  EXPECT_EQ(next["fillings"], Json::parse(R"([{"liquid": "empty"}])"));
  next["sensor"]["noise"] = "device", next["mode"] = "geometric";  // for the sake of time, as the first folder
  write_json(folder / "next.json", next);
  const ProgramRun more =
      run_fathom("campaign " + path("next.json") + " --seed 2 --model " + path("truth.json") + " -o " + path("more"));
  ASSERT_EQ(more.exit_code, 0) << more.err;
  const Json after = diagnosis("both", path("more"));
  EXPECT_TRUE(is_in_set(after, "cup_bottom_height")) << after["ambiguity_set"];
  EXPECT_FALSE(is_in_set(after, "fill_offset") || is_in_set(after, "foam")) << after["ambiguity_set"];
}

TEST_F(DiagnoseCommand, WhatIsSeenOnceASessionIsConfirmedByTheSessionsItAsksFor) {
  Json spec = kSpec;
  spec["pours"] = 2;
  spec["effects"] = {{{"name", "depth_quantization"}, {"law", 0}, {"step_px", 0.25}}};
  for (const int sessions : {1, 3}) {
    spec["sessions"] = sessions;
    write_json(folder / "spec.json", spec);
    std::filesystem::remove_all(folder / "campaign");
    ASSERT_EQ(run_fathom("campaign " + path("spec.json") + " -o " + path("campaign")).exit_code, 0);
    const Json report = diagnosis("out");
    const std::string answer = report["answer"];
    EXPECT_EQ(report["verdict"], sessions == 1 ? "ambiguous" : "named") << answer;
    EXPECT_EQ(answer.find("two more sessions") != std::string::npos, sessions == 1) << answer;
  }
}

TEST_F(DiagnoseCommand, FoldersThatGoTogetherHaveOneRig) {
  measure(Json::array());
  std::filesystem::copy(folder / "campaign", folder / "other", std::filesystem::copy_options::recursive);
  Json rig = read_json(folder / "other" / "rig.json");
  rig["sensor"]["height_mm"] = 651;
  write_json(folder / "other" / "rig.json", rig);
  const ProgramRun run = run_fathom("diagnose " + path("campaign") + " " + path("other") + " -o " + path("out"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err.rfind("error: " + path("other/rig.json") + ": /sensor/height_mm: must be as in ", 0), 0u)
      << run.err;
}

TEST_F(DiagnoseCommand, SaysWhatIsMissing) {
  measure(Json::array());
  write_text(folder / "campaign" / "frames.csv",
             "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud,height_mm\n"
             "0,0,0,0,0,0,water,20,200,0,,13.2\n");
  const Json report = diagnosis("out");
  EXPECT_EQ(report["verdict"], "insufficient");
  EXPECT_FALSE(report["missing"].empty());
}

TEST_F(DiagnoseCommand, MistakesStandInEveryReport) {
  measure(Json::array());
  Table frames = read_table(folder / "campaign" / "frames.csv");
  for (std::size_t row = 0; row < frames.rows(); ++row)
    frames.set(row, "fill_mm", fmt::format("{}", 0.1 * frames.number(row, "fill_mm")));
  write_table(folder / "campaign" / "frames.csv", frames);
  const Json report = diagnosis("out");
  const std::string sentence = "Fills were written down in centimetres, not in millimetres.";
  const Json mistake{{"name", "unit_error"}, {"sentence", sentence}};
  EXPECT_EQ(report["effects"], Json::array({mistake}));
  EXPECT_EQ(read_json(folder / "out" / "model.json")["provenance"]["mistakes"], Json::array({mistake}));
  EXPECT_NE(read_text(folder / "out" / "report.html").find("<td>" + sentence + "</td>"), std::string::npos);
}

TEST_F(DiagnoseCommand, AKilledRunLeavesWholeFilesOnly) {
  measure(Json::array());
  for (const int files : {1, 3, 5, 8}) {
    std::filesystem::remove_all(folder / "out");
    const std::string killed = fmt::format(
        "{} diagnose {} -o {} > /dev/null 2>&1 & run=$!; "
        "until [ $(ls -A {} 2> /dev/null | wc -l) -ge {} ] || ! kill -0 $run; do sleep 0.002; done; kill -KILL $run",
        FATHOM_PROGRAM, path("campaign"), path("out"), path("out"), files);
    ASSERT_EQ(std::system(killed.c_str()), 0) << "it ended before it wrote " << files << " files";
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
      if (entry.path().filename().string().starts_with('.')) continue;
      const bool is_html = entry.path().extension() == ".html", is_json = entry.path().extension() == ".json";
      EXPECT_TRUE(!is_html || read_text(entry.path()).ends_with("</html>\n")) << entry.path();
      EXPECT_NO_THROW(is_json ? read_json(entry.path()) : Json()) << entry.path();
    }
  }
  diagnosis("out");
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
    EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
}

TEST_F(DiagnoseCommand, KnowsTwoFidelities) {
  const ProgramRun run = run_fathom("diagnose " + path("campaign") + " --fidelity exact -o " + path("out"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--fidelity: exact not in {geometric,photometric}"), std::string::npos) << run.err;
}

// Three conditions, so that some twenty images are enough.
TEST_F(DiagnoseCommand, WholeFramesSayWhatFewRaysSaidOfAShallowerSensor) {
  Json spec = kSpec;
  spec["fillings"] = {{{"liquid", "empty"}}};
  spec["lateral_mm"] = {0};
  spec["effects"] = {{{"name", "sensor_pitch"}, {"pitch_deg", -1.0}}};
  write_json(folder / "spec.json", spec);
  ASSERT_EQ(run_fathom("campaign " + path("spec.json") + " -o " + path("campaign")).exit_code, 0);
  const Json report = diagnosis("out", "--fidelity photometric");
  ASSERT_EQ(report["verdict"], "named") << report["answer"];
  ASSERT_EQ(report["effects"].size(), 1u);
  const Json& effect = report["effects"][0];
  EXPECT_EQ(effect["name"], "sensor_pitch");
  EXPECT_TRUE(effect["fit"]) << effect["cosine"];
  const Json& interval = effect["parameters"]["pitch_deg"]["ci95"];
  EXPECT_NEAR(effect["parameters"]["pitch_deg"]["value"], -1.0, interval[1].get<double>() - interval[0].get<double>());
  EXPECT_EQ(report["geometric"]["effects"][0]["name"], "sensor_pitch");
  EXPECT_LT(report["gap"]["train"]["after_rms_mm"], report["gap"]["train"]["before_rms_mm"]);
  for (const Json& line : report["budget"]["conditions"])
    EXPECT_EQ(line["u_num"], std::abs(line["surrogate_minus_ray_traced"].get<double>())) << line;
}

TEST_F(DiagnoseCommand, RefusesWhatIsNoMeasurement) {
  measure(Json::array());
  write_text(folder / "campaign" / "frames.csv", "frame,session\n0,0\n");
  const ProgramRun run = run_fathom("diagnose " + path("campaign") + " -o " + path("out"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err.rfind("error: " + path("campaign/frames.csv") + ": line 1: has no column", 0), 0u) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace fathom
