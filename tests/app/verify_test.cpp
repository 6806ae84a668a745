// `fathom verify` as users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/json.h"
#include "tests/app/run_fathom.h"

namespace fathom {
namespace {

const std::string kSlab =
    "verify slab --index 1 --absorption-per-mm 0.1 --scattering-per-mm 0.9 --anisotropy 0.75 --thickness-mm 2 ";

TEST(VerifyCommand, SlabPrintsTotalsAndTheSpecularPart) {
  const ProgramRun run = run_fathom(kSlab + "--json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json light = Json::parse(run.out);
  const auto expect = [&](const char* name, double published) {
    const double value = light[name]["value"], error = light[name]["standard_error"];
    EXPECT_LE(error, 0.002 * value) << name;
    EXPECT_LT(std::abs(value - published), 4.0 * error) << name;  // once in 16 000 times with a fresh seed
  };
  expect("reflectance_total", 0.09739);  // van de Hulst 1980
  expect("transmittance_total", 0.66096);
  EXPECT_EQ(light["reflectance_specular"]["value"], 0.0);
}

TEST(VerifyCommand, GivesTheSameBytesForAnyNumberOfThreads) {
  const std::string one = run_fathom(kSlab + "--photons 5000 --json --threads 1").out;
  EXPECT_EQ(one, run_fathom(kSlab + "--photons 5000 --json --threads 2").out);
  EXPECT_NE(one, run_fathom(kSlab + "--photons 5000 --json --seed 2").out);
}

TEST(VerifyCommand, TakesHalfSpaces) {
  const ProgramRun run = run_fathom(
      "verify slab --index 1.5 --absorption-per-mm 0.1 --scattering-per-mm 0.9 --anisotropy 0 --thickness-mm inf "
      "--json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json light = Json::parse(run.out);
  const double error = light["reflectance_total"]["standard_error"];
  EXPECT_LT(std::abs(light["reflectance_total"]["value"].get<double>() - 0.25994), 4.0 * error);  // Giovanelli 1955
  EXPECT_NEAR(light["reflectance_specular"]["value"].get<double>(), 0.04, 1e-12);
  EXPECT_EQ(light["transmittance_total"]["value"], 0.0);
}

TEST(VerifyCommand, PrintsFresnelsReflectance) {
  const ProgramRun run = run_fathom("verify fresnel --from 1 --to 1.328 --angle-deg 60 --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  // Half a unit of the last printed digit.
  EXPECT_NEAR(Json::parse(run.out)["reflectance"]["value"].get<double>(), 0.058748, 5e-7);
}

TEST(VerifyCommand, AllTablesPass) {
  const ProgramRun run = run_fathom("verify all --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Json rows = Json::parse(run.out);
  EXPECT_GT(rows.size(), 20u);
  for (const Json& row : rows) {
    EXPECT_EQ(row["passed"], true) << row.dump();
    EXPECT_LE(row["standard_error"].get<double>(), 0.002 * row["value"].get<double>()) << row.dump();
  }
}

TEST(VerifyCommand, RefusesImpossibleValues) {
  for (const std::string wrong : {"--index 0", "--absorption-per-mm -1", "--scattering-per-mm nan", "--anisotropy 1",
                                  "--thickness-mm 0", "--angle-deg 90"}) {
    const std::string option = wrong.substr(0, wrong.find(' '));
    std::string arguments = "verify slab " + wrong;
    for (const std::string other :
         {"--index 1.3", "--absorption-per-mm 1", "--scattering-per-mm 1", "--anisotropy 0", "--thickness-mm 1"})
      if (!other.starts_with(option)) arguments += " " + other;
    const ProgramRun run = run_fathom(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_NE(run.err.find(option + ": must be a number"), std::string::npos) << run.err;
  }
}

TEST(VerifyCommand, RefusesWalksWithoutAnEnd) {
  for (const std::string endless :
       {"--scattering-per-mm 1 --thickness-mm 1e9", "--scattering-per-mm 1e9 --thickness-mm 1",
        "--scattering-per-mm 1e9 --thickness-mm 1e9 --photons 2", "--scattering-per-mm 1e-9 --thickness-mm 1",
        "--scattering-per-mm 1 --thickness-mm 1e-9",
        "--scattering-per-mm 1 --thickness-mm 1 --photons 1099511627776"}) {
    const ProgramRun run = run_fathom("verify slab --index 1.33 --absorption-per-mm 0 --anisotropy 0 " + endless);
    EXPECT_EQ(run.exit_code, 1) << endless;
    EXPECT_NE(run.err.find("error: verify slab: "), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("allowed"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  // Index so low that what has entered hardly leaves.
  EXPECT_EQ(run_fathom("verify slab --index 1e-9 --absorption-per-mm 0 --scattering-per-mm 0 --anisotropy 0 "
                       "--thickness-mm 1")
                .exit_code,
            1);
  // Or nothing enters at all.
  const ProgramRun mirror = run_fathom(
      "verify slab --index 1e-300 --absorption-per-mm 0 --scattering-per-mm 0 --anisotropy 0 --thickness-mm 1 --json");
  ASSERT_EQ(mirror.exit_code, 0) << mirror.err;
  EXPECT_EQ(Json::parse(mirror.out)["reflectance_total"]["value"], 1.0);
}

TEST(VerifyCommand, AnswersBadUsageWithTwo) {
  EXPECT_EQ(run_fathom("verify").exit_code, 2);
  EXPECT_EQ(run_fathom("verify slab --index 1.3").exit_code, 2);
  EXPECT_EQ(run_fathom("verify fresnel --from 1 --to 1.3 --angle-deg 0 --index 1").exit_code, 2);
  EXPECT_EQ(run_fathom("verify slab --help").exit_code, 0);
}

}  // namespace
}  // namespace fathom
