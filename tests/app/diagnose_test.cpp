// What `fathom diagnose` promises: silence where nothing is hidden, the name and size of what is, and a model that has
// it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "core/files.h"
#include "core/json.h"
#include "core/rng.h"
#include "core/table.h"
#include "core/units.h"
#include "report/whole_picture.h"
#include "tests/app/run_fathom.h"
#include "tests/app/svg_text.h"
#include "tests/core/file_size_limit.h"
#include "tests/core/temporary_folder.h"
#include "theory/raised_bottom.h"

namespace fathom {
namespace diagnose_test {

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

/// A unit whose disparities are off by 0.1 px, smoothly over the image, as every unit's are.
Json unit_of(const std::string& model) {
  return {{"model", model}, {"height_mm", 650}, {"aim_mm", {0, 300, 0}}, {"unit", {{"serial", 7}}}};
}

/// A table of heights alone, as the theory has them and a little noise, of liquids that are all water.
void write_heights(const std::filesystem::path& campaign, const std::vector<std::string>& labels) {
  Json rig = {{"sensor", {{"model", "xtion_pro_live"}, {"height_mm", 650}, {"pitch_deg", 58.4}}},
              {"cup", {{"shape", "paper_cup"}}}};
  Table frames({"frame", "session", "pour", "placement", "trial", "time_s", "liquid", "fill_mm", "distance_mm",
                "lateral_mm", "cloud", "height_mm", "height_sd_mm", "points"});
  Rng rng(1);
  int pour = 0;
  for (const std::string& label : labels) {
    rig["liquids"][label] = "water";
    for (const double fill_mm : {10.0, 30.0})
      for (int i = 0; i < 3; ++i, ++pour)
        for (const double distance_mm : {200.0, 300.0, 400.0}) {
          const double raised_m = theory::raised_height_at(
              metres_from_mm(fill_mm), {.h = 0.643, .b = 0.075, .d = metres_from_mm(distance_mm), .n = 1.329});
          const std::string number = fmt::format("{}", frames.rows());
          frames.add({number, "0", fmt::format("{}", pour), number, "0", fmt::format("{}", 10 * frames.rows()), label,
                      fmt::format("{}", fill_mm), fmt::format("{}", distance_mm), "0", "",
                      fmt::format("{:.3f}", 7.0 + mm_from_metres(raised_m) + 0.3 * rng.normal()), "1.0", "900"});
        }
  }
  make_directory(campaign);
  write_json(campaign / "rig.json", rig);
  write_table(campaign / "frames.csv", frames);
}

struct DiagnoseCommand : testing::Test {
  TemporaryFolder folder;

  std::string path(const std::string& name) const { return (folder / name).string(); }

  void measure(const Json& effects, const Json& sensor = kSpec["sensor"]) {
    Json spec = kSpec;
    spec["effects"] = effects;
    spec["sensor"] = sensor;
    write_json(folder / "spec.json", spec);
    ASSERT_EQ(run_fathom("campaign " + path("spec.json") + " -o " + path("campaign")).exit_code, 0);
  }

  Json diagnosis(const std::string& output, const std::string& options = "") {
    const ProgramRun run = run_fathom("diagnose " + path("campaign") + " " + options + " -o " + path(output));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read_json(folder / output / "report.json");
  }

  /// The effect is named with its size, and a model that has it leaves no gap.
  void expect_found(const std::string& effect, const std::string& parameter, double value,
                    const Json& sensor = kSpec["sensor"]) {
    measure({{{"name", effect}, {parameter, value}}}, sensor);
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
  for (const char* file :
       {"report.html", "next.json", "residuals.csv", "shots.json", "heights.png", "map.png", "sessions.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / file)) << file;
  diagnosis("again", "--threads 1");
  for (const char* file : {"report.json", "report.html", "model.json", "residuals.csv", "shots.json"})
    EXPECT_EQ(read_text(folder / "out" / file), read_text(folder / "again" / file)) << file;
}

TEST_F(DiagnoseCommand, LearnsTheUnitBeforeItBlamesThePhysics) {
  for (const char* model : {"xtion_pro_live_device", "kinect_v1_device"}) {
    Json spec = kSpec;
    spec["sensor"] = unit_of(model);
    spec["effects"] = Json::array();
    const std::string name = model;
    write_json(folder / (name + ".json"), spec);
    ASSERT_EQ(run_fathom("campaign " + path(name + ".json") + " -o " + path(name)).exit_code, 0);
    ASSERT_EQ(run_fathom("diagnose " + path(name) + " -o " + path(name + "_out")).exit_code, 0);
    const Json report = read_json(folder / (name + "_out") / "report.json");
    EXPECT_EQ(report["verdict"], "none") << report["answer"];
    EXPECT_TRUE(report["effects"].empty());
  }
}

TEST_F(DiagnoseCommand, SaysWhatItCostsThatNoViewShowsTheBareDesk) {
  Json spec = kSpec;
  spec["distance_mm"] = {250};
  spec["lateral_mm"] = {0};
  spec["bare_desk_views"] = 0;
  write_json(folder / "spec.json", spec);
  ASSERT_EQ(run_fathom("campaign " + path("spec.json") + " -o " + path("campaign")).exit_code, 0);
  const auto says_so = [](const Json& notes) {
    return std::any_of(notes.begin(), notes.end(), [](const Json& note) {
      return note.get<std::string>().find("No view shows the bare desk") != std::string::npos;
    });
  };
  EXPECT_TRUE(says_so(diagnosis("out")["notes"]));
}

TEST_F(DiagnoseCommand, SaysWhatItWasToldNotToLookForAndNothingElse) {
  write_heights(folder / "campaign", {"water"});
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

// The plane that a unit's bias may hold turns the desk by up to 0.2°, so a smaller turn is not known to a quarter.
TEST_F(DiagnoseCommand, FindsASensorThatIsTurned) { expect_found("sensor_roll", "roll_deg", 1.2); }

TEST_F(DiagnoseCommand, FindsCupsThatHoldMore) {
  expect_found("fill_scale", "scale", 0.15, unit_of("xtion_pro_live_device"));
}

// Its corners are 1 px off the plane: more than things on a desk may be that pass for it. The cup is not to blame.
TEST_F(DiagnoseCommand, FindsALensThatBendsTheDesk) {
  const std::string spec = FATHOM_SCENES "/campaigns/bent_desk.json";
  ASSERT_EQ(run_fathom("campaign " + spec + " -o " + path("campaign")).exit_code, 0);
  const Json report = diagnosis("out");
  EXPECT_EQ(report["verdict"], "named") << report["answer"];
  ASSERT_EQ(report["effects"].size(), 1u) << report["answer"];
  EXPECT_EQ(report["effects"][0]["name"], "radial_distortion");
  const Json& ci95 = report["effects"][0]["parameters"]["k1"]["ci95"];
  EXPECT_LT(ci95[0].get<double>(), 0.05);
  EXPECT_GT(ci95[1].get<double>(), 0.05);
}

// Of deep water half the heights are too far off to count.
TEST_F(DiagnoseCommand, FindsWavesByWhatStraysFromTheMedian) {
  Json spec = read_json(FATHOM_SCENES "/campaigns/bent_desk.json");
  spec.erase("$schema");
  spec["effects"] = {{{"name", "ripples"}, {"mean_square_slope", 0.005}}};
  write_json(path("waves.json"), spec);
  ASSERT_EQ(run_fathom("campaign " + path("waves.json") + " -o " + path("campaign")).exit_code, 0);
  const Json report = diagnosis("out");
  EXPECT_EQ(report["verdict"], "named") << report["answer"];
  ASSERT_EQ(report["effects"].size(), 1u) << report["answer"];
  EXPECT_EQ(report["effects"][0]["name"], "ripples");
  const Json& notes = report["notes"];
  EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
    return note.find("more than 6 mm from the median") != std::string::npos &&
           note.find("45 mm of water") != std::string::npos;
  })) << notes;
}

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
  EXPECT_NEAR(before["ambiguity_set"][0]["sizes"][0]["parameters"].front()["value"].get<double>(), 4.0, 1.0);
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
  const std::string page = read_text(folder / "both" / "report.html");
  for (const char* clouds : {"href=\"../campaign/clouds/", "href=\"../more/clouds/"})
    EXPECT_NE(page.find(clouds), std::string::npos) << clouds;
}

/// Combs alone are no gap; what they may be, and what would confirm it, stands in a note.
TEST_F(DiagnoseCommand, ACoarserLawIsNamedFromOneSession) {
  Json spec = kSpec;
  spec["pours"] = 2;
  spec["effects"] = {{{"name", "depth_quantization"}, {"law", 0}, {"step_px", 0.25}}};
  write_json(folder / "spec.json", spec);
  ASSERT_EQ(run_fathom("campaign " + path("spec.json") + " -o " + path("campaign")).exit_code, 0);
  const Json report = diagnosis("out");
  EXPECT_EQ(report["verdict"], "named") << report["answer"];
  EXPECT_EQ(report["effects"].at(0).at("name"), "depth_quantization") << report["answer"];
}

TEST_F(DiagnoseCommand, FoldersThatGoTogetherHaveOneRig) {
  write_heights(folder / "campaign", {"water"});
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
  write_heights(folder / "campaign", {"water"});
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
  write_heights(folder / "campaign", {"water"});
  for (const int files : {1, 3, 5, 8}) {
    std::filesystem::remove_all(folder / "out");
    const std::string killed = fmt::format(
        "{} diagnose {} -o {} > /dev/null 2>&1 & run=$!; "
        "until {{ set -- {}/*; [ -e $1 ] && [ $# -ge {} ]; }} || ! kill -0 $run; do :; done; "
        "kill -KILL $run && {{ wait $run; true; }}",
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

TEST_F(DiagnoseCommand, APictureShowsTheLabelsAsWrittenAndNobodyObeysThem) {
  const std::vector<std::string> labels{
      "x'; system('touch pwned'); set label 'y", "farmer's milk", "a`touch pwned`b",
      "@x $y \"z\" \\n {/Bold b}_1^2",           "牛乳_α, ½",     "no font has \U0010FFFD"};
  write_heights(folder / "campaign", labels);
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  const Json report = diagnosis("out");
  std::filesystem::current_path(here);
  ASSERT_NE(report["verdict"], "insufficient") << report["answer"];
  for (const bool again : {false, true}) {
    if (again) {
      std::filesystem::remove(folder / "out" / "heights.svg");
      ASSERT_EQ(std::system(fmt::format("cd {} && gnuplot -d heights.gp", path("out")).c_str()), 0);
    }
    const std::string svg = read_text(folder / "out" / "heights.svg");
    for (const std::string& label : labels) EXPECT_TRUE(shows(svg, label)) << label;
    // In the PNG a box in its place would cover all.
    const std::string script = read_text(folder / "out" / "heights.gp");
    EXPECT_LT(script.find("no font has \\134u10fffd"), script.find("no font has \U0010FFFD"));
    for (const char* place : {"pwned", "out/pwned", "campaign/pwned"})
      EXPECT_FALSE(std::filesystem::exists(folder / place)) << place;
  }
}

TEST_F(DiagnoseCommand, AReportHasTheNameOfItsFolderWhereAPathEndsWithASlash) {
  write_heights(folder / "campaign", {"water"});
  const ProgramRun run = run_fathom("diagnose '" + path("campaign") + "/' -o '" + path("out") + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(read_text(folder / "out" / "report.html").find("<h1>Diagnosis of campaign</h1>"), std::string::npos);
}

TEST_F(DiagnoseCommand, WhatIsPrintedCarriesNoControlCharacters) {
  write_heights(folder / "campaign\x1b[2J", {"water\x1b]0;title\x07", "tea\u009b2J"});
  for (const char* options : {"", " --json"}) {
    const ProgramRun run =
        run_fathom("diagnose '" + path("campaign\x1b[2J") + "' -o '" + path("o\x1b[2Jut") + "'" + options);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* control : {"\x1b", "\x07", "\u009b"}) EXPECT_EQ(run.out.find(control), std::string::npos);
  }
  EXPECT_EQ(read_text(folder / "o\x1b[2Jut" / "report.html").find('\x1b'), std::string::npos);
}

std::map<std::string, std::string> files_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename().string()] = read_text(entry.path());
  return files;
}

TEST_F(DiagnoseCommand, LeavesNothingOfAnOlderDiagnosisAndAllThatIsNotOfOne) {
  write_heights(folder / "campaign", {"water"});
  diagnosis("out");
  for (const char* name : {"notes.txt", "next_week.json", "next_.json", "map.pdf"})
    write_text(folder / "out" / name, "mine");
  write_text(folder / "out" / "next_7.json", "{}");
  write_text(folder / "campaign" / "frames.csv",
             "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud,height_mm\n"
             "0,0,0,0,0,0,water,20,200,0,,13.2\n");
  EXPECT_EQ(diagnosis("out")["verdict"], "insufficient");
  auto left = files_in(folder / "out");
  for (const char* name : {"notes.txt", "next_week.json", "next_.json", "map.pdf"})
    EXPECT_EQ(left.extract(name).mapped(), "mine") << name;
  diagnosis("fresh");
  EXPECT_EQ(left, files_in(folder / "fresh"));
}

TEST_F(DiagnoseCommand, InAMeasurementsFolderItLeavesWhatWasMeasured) {
  write_heights(folder / "campaign", {"water"});
  ASSERT_EQ(run_fathom("measure " + path("campaign")).exit_code, 0);
  const auto before = files_in(folder / "campaign");
  const ProgramRun run = run_fathom(fmt::format("diagnose {0} -o {0}", path("campaign")));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err, "error: " + path("campaign/heights.csv") +
                         ": is there already, and of no diagnosis; choose another folder\n");
  EXPECT_EQ(files_in(folder / "campaign"), before);
}

// Whoever finds report.json finds one diagnosis, the older or the newer.
TEST_F(DiagnoseCommand, AKilledRunLeavesNoReportOfTwo) {
  write_heights(folder / "campaign", {"water"});
  diagnosis("older");
  write_heights(folder / "campaign", {"water", "tea"});
  diagnosis("newer");
  const auto older = files_in(folder / "older"), newer = files_in(folder / "newer");
  for (const char* file : {"heights.csv", "heights.gp", "report.html", "model.json"}) {
    std::filesystem::remove_all(folder / "out");
    std::filesystem::copy(folder / "older", folder / "out");
    write_text(folder / "stamp", "");
    const std::string killed = fmt::format(
        "{} diagnose {} -o {} > /dev/null 2>&1 & run=$!; "
        "until [ {} -nt {} ] || ! kill -0 $run; do sleep 0.001; done; kill -KILL $run; wait $run; true",
        FATHOM_PROGRAM, path("campaign"), path("out"), path(std::string("out/") + file), path("stamp"));
    ASSERT_EQ(std::system(killed.c_str()), 0);
    auto left = files_in(folder / "out");
    std::erase_if(left, [](const auto& one) { return one.first.starts_with('.'); });
    EXPECT_TRUE(!left.contains("report.json") || left == older || left == newer) << file;
  }
  diagnosis("out");
  EXPECT_EQ(files_in(folder / "out"), newer);
}

TEST_F(DiagnoseCommand, OnAFullDiskNoHalfPictureIsLeftAndNoReport) {
  write_heights(folder / "campaign", {"water"});
  diagnosis("out");
  const std::uintmax_t png = std::filesystem::file_size(folder / "out" / "heights.png"),
                       svg = std::filesystem::file_size(folder / "out" / "heights.svg");
  for (const std::uintmax_t room : {png - 1, svg - std::string("</svg>\n").size()}) {
    const FileSizeLimit limit(room);
    const ProgramRun run = run_fathom("diagnose " + path("campaign") + " -o " + path("out"));
    EXPECT_EQ(run.exit_code, 1) << room;
    EXPECT_EQ(run.err.rfind("error: " + path("out/"), 0), 0u) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out" / "report.json"));
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
      const bool is_picture = entry.path().extension() == ".png" || entry.path().extension() == ".svg";
      EXPECT_TRUE(!is_picture || is_whole_picture(entry.path())) << entry.path();
    }
  }
  EXPECT_NE(diagnosis("out")["verdict"], "insufficient");
}

TEST_F(DiagnoseCommand, KnowsTwoFidelities) {
  const ProgramRun run = run_fathom("diagnose " + path("campaign") + " --fidelity exact -o " + path("out"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--fidelity: unknown fidelity 'exact', choose from geometric, photometric"), std::string::npos)
      << run.err;
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
  write_heights(folder / "campaign", {"water"});
  write_text(folder / "campaign" / "frames.csv", "frame,session\n0,0\n");
  const ProgramRun run = run_fathom("diagnose " + path("campaign") + " -o " + path("out"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err.rfind("error: " + path("campaign/frames.csv") + ": line 1: has no column", 0), 0u) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace diagnose_test
}  // namespace fathom
