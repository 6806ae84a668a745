// Cups tell by their walls in what way their places were written down.
#include "diagnosis/measurement/places.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/cloud_file.h"
#include "core/files.h"
#include "core/units.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace places_test {

constexpr double kHeight = 0.650, kFocal = 570.342, kPitchDeg = 58.4, kHalfBaseline = 0.0375;
constexpr double kRim = 0.087, kInner = 0.040, kOuter = 0.043, kBottom = 0.007;  // [m] the paper's cup

/// Distance along a line of sight at which it leaves (or enters) an upright cylinder; nothing where it misses it.
std::optional<double> meets(const Eigen::Vector3d& from, const Eigen::Vector3d& sight, double radius, bool leaves) {
  const double a = sight.head<2>().squaredNorm(), b = from.head<2>().dot(sight.head<2>()),
               c = from.head<2>().squaredNorm() - radius * radius, under = b * b - a * c;
  if (under < 0.0) return std::nullopt;
  return (-b + (leaves ? 1.0 : -1.0) * std::sqrt(under)) / a;
}

/// An ideal sensor's cloud of a desk with a cup at (`lateral`, `distance`) of the rig's middle, `size` times as large
/// as the paper's, in which milk stands at `level`.
Image<CloudPoint> cloud_of_cup(double lateral, double distance, double size = 1.0, double level = kBottom) {
  const double pitch = radians_from_deg(kPitchDeg);
  const Eigen::Vector3d camera(-kHalfBaseline - lateral, -distance, kHeight);  // from the cup's foot
  Image<CloudPoint> cloud(640, 480);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      const double u = (x + 0.5 - 320.0) / kFocal, v = (y + 0.5 - 240.0) / kFocal;
      const Eigen::Vector3d sight(u, std::cos(pitch) - v * std::sin(pitch), -std::sin(pitch) - v * std::cos(pitch));
      const auto height_at = [&](double z) { return camera.z() + z * sight.z(); };
      double z = kHeight / -sight.z();
      const Eigen::Vector3d at_rim = camera + sight * ((kHeight - size * kRim) / -sight.z());
      if (at_rim.head<2>().norm() < size * kInner) {
        z = std::min((kHeight - level) / -sight.z(), *meets(camera, sight, size * kInner, true));
      } else if (const auto outside = meets(camera, sight, size * kOuter, false);
                 outside && height_at(*outside) > 0.0 && height_at(*outside) < size * kRim) {
        z = *outside;
      }
      cloud(x, y) = {static_cast<float>(z * u), static_cast<float>(z * v), static_cast<float>(z), 100.0f};
    }
  return cloud;
}

struct Places : testing::Test {
  TemporaryFolder folder;
  std::string rows = "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,cloud\n";
  int next = 0;

  void SetUp() override {
    make_directory(folder / "clouds");
    write_text(folder / "rig.json",
               fmt::format(R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": {}}},
                   "cup": {{}}, "liquids": {{}}}})",
                           kPitchDeg));
  }
  /// A cup that stands at (`lateral_mm`, `distance_mm`) and is said to stand at (`said_lateral_mm`,
  /// `said_distance_mm`).
  void add(double lateral_mm, double distance_mm, double said_lateral_mm, double said_distance_mm, int session = 0) {
    const std::string name = fmt::format("clouds/{}.pcd", next);
    write_pcd(folder / name, cloud_of_cup(metres_from_mm(lateral_mm), metres_from_mm(distance_mm)));
    rows += fmt::format("{0},{1},0,{0},0,{0},empty,0,{2},{3},{4}\n", next, session, said_distance_mm, said_lateral_mm,
                        name);
    ++next;
  }
  Measurement read() {
    write_text(folder / "frames.csv", rows);
    return read_measurement(folder / "");
  }
  /// One mistake, and all cups where they stand.
  void expect_mistake(const char* id, const std::string& sentence) {
    const Measurement measurement = read();
    ASSERT_EQ(measurement.mistakes.size(), 1u);
    EXPECT_EQ(measurement.mistakes[0].id, id);
    EXPECT_EQ(measurement.mistakes[0].sentence, sentence);
    int walls = 0;
    for (const Observation& o : measurement.observations) {
      if (o.observable != "cup_x_mm" && o.observable != "cup_y_mm") continue;
      EXPECT_NEAR(o.value, 0.0, 0.5);  // mm: pixels step over the borders of what counts as wall
      ++walls;
    }
    EXPECT_EQ(walls, 2 * next);
  }
};

TEST_F(Places, LateralsInCentimetresArePutRight) {
  for (const double lateral_mm : {-100.0, -60.0, 60.0, 100.0}) add(lateral_mm, 300, 0.1 * lateral_mm, 300);
  add(0, 300, 0, 300);
  expect_mistake("unit_error", "Laterals were written down in centimetres, not in millimetres: 4 of 4 cups stand so.");
}

TEST_F(Places, DistancesToTheCupsFrontArePutRight) {
  for (const double distance_mm : {250.0, 300.0, 350.0, 400.0}) add(0, distance_mm, 0, distance_mm - 43);
  expect_mistake("distance_to_front",
                 "Distances were measured to the cup's front, not to its axis: 4 of 4 cups stand so.");
}

TEST_F(Places, ASessionMayHaveItsOwnMistake) {
  for (const double lateral_mm : {-100.0, -50.0, 50.0, 100.0}) {
    add(lateral_mm, 300, lateral_mm, 300, 1);
    add(lateral_mm, 300, -lateral_mm, 300, 2);
  }
  expect_mistake("flipped_axis", "The lateral axis is flipped in session 2: 4 of 4 cups beside it stand mirrored.");
}

TEST_F(Places, AnotherCupIsNoOtherPlace) {
  for (const double size : {0.8, 1.2, 1.3}) {
    for (const double level : {0.03, 0.04, 0.05})
      for (const double distance_mm : {250.0, 400.0}) {
        add(0, distance_mm, 0, distance_mm);
        write_pcd(folder / fmt::format("clouds/{}.pcd", next - 1),
                  cloud_of_cup(0.0, metres_from_mm(distance_mm), size, level));
      }
    EXPECT_TRUE(read().mistakes.empty()) << size;
    rows.resize(rows.find('\n') + 1);
  }
}

// The bias of a sensor that hangs high lowers a thin bottom to the desk and moves walls by a centimetre. A step farther
// the wall would pass for a bottom.
TEST_F(Places, ACupThatStandsNearbyIsNotLookedForElsewhere) {
  write_text(
      folder / "rig.json",
      fmt::format(R"({{"sensor": {{"model": "xtion_pro_live", "height_mm": 650, "pitch_deg": {}}}, "liquids": {{}},
                 "cup": {{"bottom_mm": 3}}}})",
                  kPitchDeg));
  for (const double distance_mm : {250.0, 300.0, 350.0, 400.0}) {
    add(0, distance_mm, 0, distance_mm);
    write_pcd(folder / fmt::format("clouds/{}.pcd", next - 1),
              cloud_of_cup(0.0, metres_from_mm(distance_mm - 10.0), 1.0, 0.0015));
  }
  EXPECT_TRUE(read().mistakes.empty());
}

TEST_F(Places, WhatIsNoMistakeOfAllIsNotPutRight) {
  for (const double lateral_mm : {-100.0, -50.0, 50.0, 100.0}) add(lateral_mm + 4, 296, lateral_mm, 300);
  for (const double lateral_mm : {-80.0, 80.0, 90.0}) add(lateral_mm, 300, -lateral_mm, 300);
  EXPECT_TRUE(read().mistakes.empty());
}

}  // namespace places_test
}  // namespace fathom
