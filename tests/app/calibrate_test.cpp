// What `fathom calibrate` promises: clouds of desks in, a unit that the simulator takes out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>

#include "core/files.h"
#include "core/image_file.h"
#include "core/json.h"
#include "sim/scene/setup.h"
#include "sim/scene/unit_model.h"
#include "sim/sensor/reference.h"
#include "tests/app/run_fathom.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct CalibrateCommand : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();

  void SetUp() override { make_directory(folder); }
  void TearDown() override { fs::remove_all(folder); }

  /// A scene with the device's faults; things stand on every other desk.
  fathom::Setup write_scene(const std::string& name, double height_mm, double aim_mm, bool cluttered,
                            const Json& unit) const {
    Json scene = {
        {"sensor",
         {{"model", "xtion_pro_live_device"}, {"height_mm", height_mm}, {"aim_mm", {0, aim_mm, 0}}, {"unit", unit}}},
        {"desk", {{"size_mm", {3000, 3000}}, {"centre_mm", {0, 600}}}}};
    if (cluttered)
      scene["cups"] = {{{"shape", "mug"}, {"position_mm", {-100, aim_mm}}},
                       {{"shape", "paper_cup"}, {"position_mm", {120, aim_mm + 60}}}};
    write_json(folder / (name + ".json"), scene);
    return read_setup(folder / (name + ".json"));
  }

  std::string capture(const std::string& name, int seed) const {
    const ProgramRun run = run_fathom(fmt::format("capture {0}/{1}.json --mode geometric --seed {2} -o {0}/{1} --quiet",
                                                  folder.string(), name, seed));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return fmt::format("{}/{}/cloud.pcd ", folder.string(), name);
  }
};

TEST_F(CalibrateCommand, ASimulatedUnitsMapComesBackFromItsClouds) {
  const Json drawn = {{"serial", 5}};
  std::string clouds;
  SensorModel sensor;
  int number = 0;
  for (const double height_mm : {600.0, 700.0, 850.0})
    for (const double aim_mm : {300.0, 420.0}) {
      const std::string name = fmt::format("desk{}", number);
      sensor = write_scene(name, height_mm, aim_mm, number % 2 == 1, drawn).rig.sensor;
      clouds += capture(name, ++number);
    }
  const fs::path unit = folder / "unit";
  const ProgramRun run = run_fathom("calibrate " + clouds + "-o " + unit.string() + " --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json rows = Json::parse(run.out);
  EXPECT_EQ(rows["clouds"]["value"], 6.0);
  EXPECT_NEAR(rows["focal_length"]["value"].get<double>(), 570.342, 0.01);
  EXPECT_EQ(rows["disparity_step"]["value"], 0.125);
  EXPECT_EQ(rows["step_phase"]["value"], 0.5);
  EXPECT_EQ(rows["depth_cut"]["value"], 1.0);
  EXPECT_LT(rows["desk_error_after"]["value"].get<double>(), 0.5 * rows["desk_error_before"]["value"].get<double>());
  EXPECT_TRUE(fs::exists(unit / "report.html"));

  // Against what the simulator displaced the remembered image by, a plane apart, where the map claims to know: at
  // pixels that see something nearer by reference_at_px.
  const Image<float> reference = read_exr_channel(unit / "unit_bias.exr", "reference_px"),
                     camera = read_exr_channel(unit / "unit_bias.exr", "camera_px"),
                     sigma = read_exr_channel(unit / "unit_bias.exr", "sigma_px");
  const double at = read_json(unit / "unit.json")["bias"]["reference_at_px"].get<double>();
  constexpr int kMargin = 100;
  const Image<float> truth = reference_residue(sensor.unit, kMargin, 640 + 2 * kMargin, 512);
  std::vector<Eigen::Vector3d> where;
  std::vector<double> left, before;
  for (int y = 24; y < 480; y += 16)
    for (int x = 24; x < 640; x += 16) {
      if (sigma(x, y) > 0.05f) continue;
      where.emplace_back(x / 320.0 - 1.0, y / 240.0 - 1.0, 1.0);
      const double known = truth(x + kMargin - static_cast<int>(at), y + 16);
      before.push_back(known);
      left.push_back(reference(x, y) + camera(x, y) - known);
    }
  ASSERT_GT(where.size(), 500u);
  const auto rms = [&](std::vector<double>& values) {
    Eigen::MatrixXd planes(static_cast<Eigen::Index>(where.size()), 3);
    for (std::size_t i = 0; i < where.size(); ++i) planes.row(static_cast<Eigen::Index>(i)) = where[i];
    Eigen::Map<Eigen::VectorXd> all(values.data(), planes.rows());
    all -= planes * (planes.transpose() * planes).inverse() * (planes.transpose() * all);
    return std::sqrt(all.squaredNorm() / static_cast<double>(values.size()));
  };
  const double without = rms(before), with = rms(left);
  EXPECT_GT(without, 0.06);
  EXPECT_LT(with, 0.3 * without);

  // The simulator takes the unit, and its desks then have the map.
  write_scene("again", 700.0, 350.0, false, "unit/unit.json");
  capture("again", 1);
}

TEST_F(CalibrateCommand, SaysInOneLineWhatIsWrongAndWritesNothing) {
  write_text(folder / "wall.ply",
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n0.1 0.1 1\n");
  const std::string cloud = (folder / "wall.ply").string(), unit = (folder / "unit").string();
  const ProgramRun run = run_fathom("calibrate " + cloud + " -o " + unit);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err, "error: " + cloud + ": no desk found: fewer than 100 points were measured\n");
  EXPECT_FALSE(fs::exists(unit));
  EXPECT_EQ(run_fathom("calibrate " + cloud).exit_code, 2);
  write_text(folder / "frames.csv", "cloud,time_s\n../wall.ply,0\n");
  EXPECT_NE(run_fathom("calibrate " + (folder / "frames.csv").string() + " -o " + unit).err.find("'../wall.ply'"),
            std::string::npos);
}

}  // namespace
}  // namespace fathom
