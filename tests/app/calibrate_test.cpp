// What `fathom calibrate` promises: clouds of desks in, a unit that the simulator takes out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/cloud_file.h"
#include "core/files.h"
#include "core/image_file.h"
#include "core/json.h"
#include "sim/scene/setup.h"
#include "sim/scene/unit_model.h"
#include "sim/sensor/reference.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct CalibrateCommand : testing::Test {
  TemporaryFolder folder;

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
    const ProgramRun run = run_fathom(fmt::format("capture {0}{1}.json --mode geometric --seed {2} -o {0}{1} --quiet",
                                                  (folder / "").string(), name, seed));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return (folder / name / "cloud.pcd ").string();
  }

  /// What an ideal device sees of a desk 0.65 m below it.
  struct Shown {
    double more_px = 0.0;       ///< of every disparity
    double focal_px = 570.342;  ///< of the cloud's rays
    int columns = 640;          ///< in which there is desk, from the left
  };
  /// The file's name and a blank.
  std::string write_desk(const std::string& name, const Shown& shown) const {
    constexpr double kProduct = 570.342 * 0.075, kPitch = 1.0;
    constexpr float kHole = std::numeric_limits<float>::quiet_NaN();
    Image<CloudPoint> cloud(640, 480, {kHole, kHole, kHole, 100.0f});
    for (int y = 0; y < 480; ++y)
      for (int x = 0; x < shown.columns; ++x) {
        const double u = (x + 0.5 - 320.0) / shown.focal_px, v = (y + 0.5 - 240.0) / shown.focal_px;
        const double true_px = kProduct * (std::sin(kPitch) + v * std::cos(kPitch)) / 0.65;
        const double z = kProduct / (true_px + shown.more_px);
        cloud(x, y) = {static_cast<float>(u * z), static_cast<float>(v * z), static_cast<float>(z), 100.0f};
      }
    write_pcd(folder / name, cloud);
    return (folder / name).string() + " ";
  }

  std::string unit() const { return (folder / "unit").string(); }
  /// Runs it to `unit()` and returns the rows.
  Json calibrate(const std::string& arguments) const {
    const ProgramRun run = run_fathom("calibrate " + arguments + " -o " + unit() + " --json --quiet");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.exit_code == 0 ? Json::parse(run.out) : Json();
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

  // The detector finds the same two cups without the bias, at heights of their own.
  const std::string cups = "detect " + (folder / "desk1/cloud.pcd").string() + " --json --quiet";
  const ProgramRun biased = run_fathom(cups), corrected = run_fathom(cups + " --unit " + (unit / "unit.json").string());
  ASSERT_EQ(corrected.exit_code, 0) << corrected.err;
  const Json before_cups = Json::parse(biased.out)["cups"], after_cups = Json::parse(corrected.out)["cups"];
  EXPECT_EQ(after_cups.size(), 2U);
  EXPECT_EQ(after_cups.size(), before_cups.size());
  EXPECT_NE(after_cups, before_cups);

  // Against what the simulator displaced the reference image by, a plane apart, where the map claims to know: at
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
  const double without_px = rms(before), with_px = rms(left);
  EXPECT_GT(without_px, 0.06);
  EXPECT_LT(with_px, 0.3 * without_px);

  // The simulator takes the unit, and its desks then have the map.
  const auto disparity_of = [&](const std::string& name, const Json& of_unit) {
    write_scene(name, 700.0, 350.0, false, of_unit);
    capture(name, 1);
    return read_exr_channel(folder / name / "disparity.exr", "Y");
  };
  const Image<float> as_learned = disparity_of("again", "unit/unit.json"),
                     without = disparity_of("without", {{"residue_px", 0.0}});
  double squares = 0.0, pixels = 0.0;
  const double at_reference = sensor.focal_px * sensor.baseline / 1.2;
  constexpr int kCells = 16;
  for (int top = 32; top < 448; top += kCells)
    for (int left_px = 64; left_px < 576; left_px += kCells) {
      double more = 0.0, map = 0.0, seen = 0.0;
      for (int y = top; y < top + kCells; ++y)
        for (int x = left_px; x < left_px + kCells; ++x) {
          if (as_learned(x, y) <= 0.0f || without(x, y) <= 0.0f) continue;
          const int column = x - static_cast<int>(std::lround(without(x, y) - at_reference - at));
          if (column < 0 || column >= 640) continue;
          more += as_learned(x, y) - without(x, y), map += reference(column, y) + camera(x, y), seen += 1.0;
        }
      if (seen < 0.5 * kCells * kCells) continue;
      squares += std::pow((more - map) / seen, 2.0), pixels += 1.0;
    }
  ASSERT_GT(pixels, 500.0);
  EXPECT_LT(std::sqrt(squares / pixels), 0.25 * without_px);
}

TEST_F(CalibrateCommand, KnowsWhereDeskWasSeen) {
  const Json whole = calibrate(write_desk("whole.pcd", {}));
  EXPECT_EQ(whole["seen_share"]["value"], 1.0);
  EXPECT_EQ(read_text(folder / "unit" / "unit_map.csv").find("nan"), std::string::npos);
  const Json half = calibrate(write_desk("half.pcd", {.columns = 320}));
  EXPECT_NEAR(half["seen_share"]["value"].get<double>(), 0.5, 0.01);
  EXPECT_LT(half["bias_sigma"]["value"].get<double>(), 0.03);  // of what was seen alone
  EXPECT_NE(read_text(folder / "unit" / "unit_map.csv").find("nan"), std::string::npos);
}

TEST_F(CalibrateCommand, CloudsWithTimesTellOfWarmingUp) {
  std::string clouds, rows, sessions;
  for (int i = 0; i < 6; ++i) {
    const std::string name = fmt::format("{}.pcd", i);
    clouds += write_desk(name, {.more_px = 0.4 * std::exp(-i * 60.0 / 200.0)});
    rows += fmt::format("{},{}\n", name, 60 * i);
    sessions += fmt::format("{},{},{}\n", name, 60 * (i % 3), i / 3);
  }
  const auto expect_warm_up = [](const Json& found) {
    ASSERT_TRUE(found.contains("warm_up")) << found;
    EXPECT_NEAR(found["warm_up"]["value"].get<double>(), 0.4, 0.01);
    EXPECT_NEAR(found["warm_up_time"]["value"].get<double>(), 200.0, 5.0);
  };
  expect_warm_up(calibrate(clouds + "--interval-s 60"));
  EXPECT_NEAR(read_json(folder / "unit" / "unit.json")["warm_up"]["warm_up_px"].get<double>(), 0.4, 0.01);
  const std::string table = (folder / "frames.csv").string();
  write_text(table, "cloud,time_s\n" + rows);
  expect_warm_up(calibrate(table));
  EXPECT_FALSE(calibrate(clouds).contains("warm_up")) << "nobody said when";
  write_text(table, "cloud,time_s,session\n" + sessions);
  EXPECT_FALSE(calibrate(table).contains("warm_up")) << "the time of each session is its own";

  const auto error_of = [&](const std::string& arguments, int exit_code) {
    const ProgramRun run = run_fathom("calibrate " + arguments + " -o " + unit());
    EXPECT_EQ(run.exit_code, exit_code);
    return run.err;
  };
  EXPECT_NE(error_of(table + " --interval-s 60", 2).find("--interval-s"), std::string::npos);
  write_text(table, "cloud,time_s\n0.pcd,-1\n");
  EXPECT_EQ(error_of(table, 1), "error: " + table + ": line 2, column 'time_s': must be at least 0, got '-1'\n");
}

TEST_F(CalibrateCommand, WhetherCloudsAreRegisteredTheyTellOrTheUserDoes) {
  const auto camera_mm = [&](const std::string& arguments) {
    const double offset_mm = calibrate(arguments)["camera_offset"]["value"].get<double>();
    EXPECT_EQ(read_json(folder / "unit" / "unit.json")["device"]["camera_mm"], offset_mm);
    return offset_mm;
  };
  const std::string infrared = write_desk("infrared.pcd", {}), colour = write_desk("colour.pcd", {.focal_px = 525.0});
  EXPECT_EQ(camera_mm(infrared), 0.0);
  EXPECT_EQ(camera_mm(infrared + "--registered"), 25.0);
  EXPECT_EQ(camera_mm(colour), 25.0);
  EXPECT_EQ(camera_mm(colour + "--unregistered"), 0.0);
}

/// One that stands there stays whole until another is.
TEST_F(CalibrateCommand, ASecondRunTakesThePlaceOfTheFirst) {
  calibrate(write_desk("a.pcd", {}));
  const std::string first = read_text(folder / "unit" / "unit.json");
  write_text(folder / "nothing.pcd", "");
  EXPECT_EQ(run_fathom("calibrate " + (folder / "nothing.pcd").string() + " -o " + unit()).exit_code, 1);
  EXPECT_EQ(read_text(folder / "unit" / "unit.json"), first);
  const Json second = calibrate(write_desk("b.pcd", {}) + (folder / "a.pcd").string());
  EXPECT_EQ(second["clouds"]["value"], 2.0);
  EXPECT_EQ(read_json(folder / "unit" / "unit.json")["source"], "fathom calibrate: 2 clouds, 1 views");
}

/// A sensor whose unit is known has errors that are known: one view of a bare desk is a measurement.
TEST_F(CalibrateCommand, OneBareDeskBeforeACalibratedSensorIsDiagnosed) {
  std::string clouds;
  for (int i = 0; i < 4; ++i) {
    const std::string name = fmt::format("desk{}", i);
    write_scene(name, 640.0 + 10.0 * i, 360.0, false, {{"serial", 5}});
    const std::string cloud = capture(name, i + 1);
    if (i < 3) clouds += cloud;
  }
  calibrate(clouds);
  const fs::path measured = folder / "unit";
  fs::copy_file(folder / "desk3" / "cloud.pcd", measured / "cloud.pcd");
  write_text(measured / "frames.csv",
             "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud\n"
             "0,0,0,0,0,0,none,0,0,0,cloud.pcd\n");
  const auto verdict_of = [&](const Json& more) {
    Json sensor = {{"model", "xtion_pro_live_device"}, {"height_mm", 670.0}, {"pitch_deg", 61.75}};
    sensor.update(more);
    write_json(measured / "rig.json",
               {{"sensor", sensor}, {"cup", {{"shape", "paper_cup"}}}, {"liquids", Json::object()}});
    const ProgramRun run =
        run_fathom(fmt::format("diagnose {} -o {} --quiet", measured.string(), (folder / "diagnosis").string()));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.exit_code == 0 ? read_json(folder / "diagnosis" / "report.json")["verdict"] : Json();
  };
  EXPECT_EQ(verdict_of({{"unit", "unit.json"}}), "none");
  EXPECT_NE(verdict_of({{"unit", "unit.json"}, {"pitch_deg", 61.0}}), "none");
  EXPECT_EQ(verdict_of(Json::object()), "insufficient");
}

TEST_F(CalibrateCommand, EachPoseHasItsChannel) {
  std::string clouds = write_desk("a.pcd", {}) + write_desk("b.pcd", {}) + write_desk("c.pcd", {.more_px = 5.0});
  EXPECT_EQ(calibrate(clouds)["poses"]["value"], 2.0);
  const Json poses = read_json(folder / "unit" / "unit.json")["bias"]["poses"];
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0]["clouds"], 2);
  EXPECT_NEAR(poses[0]["height_mm"].get<double>(), 650.0, 0.1);
  EXPECT_NEAR(poses[0]["roll_deg"].get<double>(), 0.0, 0.05);
  EXPECT_EQ(read_exr_channel(folder / "unit" / "unit_bias.exr", poses[1]["channel"].get<std::string>()).width(), 640);
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
