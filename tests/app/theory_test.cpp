// `fathom theory` as users run it, and what holds for every command.
#include <gtest/gtest.h>

#include <string>

#include "core/files.h"
#include "core/json.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

struct Outcome {
  int exit_code;
  std::string text;  ///< stdout and stderr
};

Outcome run_program(const std::string& arguments) {
  const ProgramRun run = run_fathom(arguments);
  return {run.exit_code, run.out + run.err};
}

TEST(TheoryCommand, PrintsTheAgreedColumns) {
  const Outcome result = run_program("theory --fill-mm 30 --distance-mm 400,600");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.text,
            "fill_mm,distance_mm,lateral_mm,incidence_projector_deg,incidence_camera_deg,eq7_mm,exact_mm,epipolar_px\n"
            "30,400,0,32.086345,32.086345,9.167075,9.210105,0.000000\n"
            "30,600,0,43.247880,43.247880,10.800130,10.889308,0.000000\n");
}

TEST(TheoryCommand, CoversThePapersFifteenConditionsByDefault) {
  const Json rows = Json::parse(run_program("theory --json").text);
  ASSERT_EQ(rows.size(), 15u);
  EXPECT_EQ(rows[12]["fill_mm"], 30.0);
  EXPECT_EQ(rows[12]["distance_mm"], 400.0);
}

TEST(TheoryCommand, TakesPointsOnBothSides) {
  const Json rows = Json::parse(run_program("theory --json --fill-mm 30 --distance-mm 400 --lateral-mm -50,50").text);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_DOUBLE_EQ(rows[0]["incidence_camera_deg"].get<double>(), rows[1]["incidence_projector_deg"].get<double>());
}

TEST(TheoryCommand, PrintsTheLargestSkew) {
  EXPECT_EQ(run_program("theory --max-skew").text, "max_skew       6.95217 deg\n");
  // The printed digits.
  EXPECT_NEAR(Json::parse(run_program("theory --max-skew --json").text)["max_skew"]["value"].get<double>(), 6.95,
              0.005);
}

TEST(TheoryCommand, RefusesImpossibleValuesAsBadUsage) {
  for (const std::string arguments :
       {"--index 0.9", "--index nan", "--fill-mm -1", "--fill-mm 10,nan", "--fill-mm 10,650", "--height-mm 0",
        "--height-mm nan", "--baseline-mm 0", "--pitch-deg 91", "--distance-mm -1", "--lateral-mm inf"}) {
    const Outcome result = run_program("theory " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    const std::string option = arguments.substr(0, arguments.find(' '));
    EXPECT_EQ(result.text.rfind("error: " + option + ": must be ", 0), 0u) << result.text;
  }
  EXPECT_EQ(run_program("theory --height-mm -inf").text,
            "error: --height-mm: must be a number above 0 and at most 1000000, got '-inf'\n"
            "Run with --help for more information.\n");
}

TEST(TheoryCommand, KeepsItsTableInTheFolderOfTheResults) {
  const TemporaryFolder folder;
  const std::string options = " --fill-mm 30 --distance-mm 400 -o " + (folder / "new").string();
  const Outcome table = run_program("theory" + options);
  EXPECT_EQ(table.text, read_text(folder / "new" / "theory.csv"));
  const Outcome json = run_program("theory --json" + options);
  EXPECT_EQ(json.text, read_text(folder / "new" / "theory.json"));
}

TEST(Commands, OnesThatDoNotExistAreNamedBesideThoseThatDo) {
  const Outcome result = run_program("theroy --fill-mm 30");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(
      result.text.rfind("error: unknown command 'theroy', choose from capture, export, theory, detect, evaluate, ", 0),
      0u)
      << result.text;
  EXPECT_NE(result.text.find(", manual; did you mean 'theory'?\n"), std::string::npos) << result.text;
  EXPECT_EQ(run_program("").text.rfind("error: a command is missing, choose from capture, ", 0), 0u);
  EXPECT_EQ(run_program("verify slap").text.rfind("error: unknown command 'slap', choose from slab, fresnel, ", 0), 0u);
  EXPECT_EQ(run_program("theory -o ''").text.rfind("error: --output: must name a folder, got ''", 0), 0u);
  EXPECT_EQ(run_program("--help").exit_code, 0);
  EXPECT_EQ(run_program("--version").exit_code, 0);
}

TEST(Options, OnesThatDoNotExistAreNamedBesideTheNearest) {
  for (const char* typed :
       {"theory --hieght-mm 650", "verify slab --hieght-mm=650", "detect --metod paper", "--verson"}) {
    const Outcome result = run_program(typed);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.text.rfind("error: unknown option '--", 0), 0u) << result.text;
  }
  EXPECT_NE(run_program("theory --hieght-mm 650").text.find("; did you mean '--height-mm'?\n"), std::string::npos);
  EXPECT_NE(run_program("verify fresnel --thread=1").text.find("; did you mean '--threads'?\n"), std::string::npos);
  EXPECT_NE(run_program("list efects").text.find("; did you mean 'effects'?\n"), std::string::npos);
}

TEST(Options, OnesThatAreRequiredAreMarked) {
  for (const char* command : {"capture", "campaign", "calibrate", "diagnose", "reproduce", "template"}) {
    EXPECT_NE(run_program(std::string(command) + " --help").text.find("-o,--output DIR REQUIRED"), std::string::npos)
        << command;
  }
  EXPECT_EQ(run_program("theory --help").text.find("-o,--output DIR REQUIRED"), std::string::npos);
}

TEST(ListCommand, KnowsEveryLibrary) {
  for (const char* library : {"media", "cups", "sensors"})
    EXPECT_FALSE(Json::parse(run_program(std::string("list --json ") + library).text).empty()) << library;
  const Json effects = Json::parse(run_program("list effects --json").text);
  EXPECT_EQ(effects.front()["name"], "sensor_height");
  EXPECT_EQ(run_program("list effects").text.rfind("sensor_height\n  family ", 0), 0u);
}

TEST(TheoryCommand, AnswersBadUsageWithTwo) {
  EXPECT_EQ(run_program("theory --no-such-option").exit_code, 2);
  EXPECT_EQ(run_program("theory --fill-mm ten").exit_code, 2);
  EXPECT_EQ(run_program("").exit_code, 2);
  EXPECT_EQ(run_program("theory --help").exit_code, 0);
}

}  // namespace
}  // namespace fathom
