// What a measurement directory must be, and what its clouds say.
#include "diagnosis/measurement/read_measurement.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/cloud_file.h"
#include "core/files.h"
#include "core/image_file.h"
#include "core/rng.h"
#include "core/units.h"
#include "detector/read_cloud.h"
#include "diagnosis/measurement/copies.h"
#include "tests/core/expect_error.h"
#include "tests/diagnosis/measurement/written_measurement.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

const std::string kHeader = std::string(kFrameColumns) + "cloud";

struct MeasurementFolder : WrittenMeasurement {
  void SetUp() override {
    WrittenMeasurement::SetUp();
    write_pcd(folder / "clouds/b.pcd", ideal_cloud(kHeight + 0.001, 0.022));
    write_pcd(folder / "clouds/tilted.pcd", ideal_cloud(kHeight, 0.020, 0.1));
    write_pcd(folder / "clouds/mm.pcd", ideal_cloud(kHeight, 0.020, 0.0, 1000.0f));
  }
  Measurement read(const std::string& rows, const std::string& header = kHeader) {
    write_text(folder / "frames.csv", header + "\n" + rows);
    return read_measurement(folder / "");
  }
  void expect_refused(const std::string& rows, const std::string& what, const std::string& header = kHeader) {
    expect_error([&] { read(rows, header); }, {(folder / "frames.csv").string() + ": " + what});
  }
};

const Observation* find(const Measurement& measurement, const char* observable, const char* region) {
  for (const Observation& observation : measurement.observations)
    if (observation.observable == observable && observation.factors.region == region) return &observation;
  return nullptr;
}

/// Bright bands, six columns of the image wide and six apart; first as bright in the cup as beside it, then a fifth of
/// that.
TEST_F(MeasurementFolder, InfraredImagesGiveTheContrastOfDots) {
  const Cloud cloud = read_cloud(folder / "clouds/a.pcd");
  Image<std::uint16_t> image(2 * cloud.width, 2 * cloud.height);
  const auto draw = [&](int dot_inside) {
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const Eigen::Vector3f& p = cloud.points[static_cast<std::size_t>(y / 2) * cloud.width + x / 2];
        const bool is_inside =
            p.allFinite() && p.z() < 0.98f * cloud.points[static_cast<std::size_t>(y / 2) * cloud.width].z();
        image(x, y) = static_cast<std::uint16_t>(100 + (x / 6 % 2 == 0 ? is_inside ? dot_inside : 100 : 0));
      }
    write_png(folder / "ir.png", image);
  };
  draw(100);
  const std::string row = "0,0,3,5,0,10,water,20,300,0,clouds/a.pcd,ir.png\n";
  const Measurement same = read(row, kHeader + ",ir");
  ASSERT_TRUE(find(same, "log_ir_contrast", "interior"));
  EXPECT_NEAR(find(same, "log_ir_contrast", "interior")->value, 0.0, 0.1);
  draw(20);
  const Measurement washed = read(row, kHeader + ",ir");
  EXPECT_LT(find(washed, "log_ir_contrast", "interior")->value, -0.7);
  EXPECT_FALSE(find(read("0,0,3,5,0,10,water,20,300,0,clouds/a.pcd\n"), "log_ir_contrast", "interior")) << "no dots";
}

/// Points after each other are no neighbours there.
TEST_F(MeasurementFolder, CloudsWithoutRowsHaveNoContrastOfDots) {
  const Image<CloudPoint> image = ideal_cloud(kHeight, 0.020);
  Image<CloudPoint> row(static_cast<int>(image.pixels().size()), 1);
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    row.pixels()[i] = image.pixels()[i];
    row.pixels()[i].intensity = i / 3 % 2 == 0 ? 200.0f : 50.0f;
  }
  write_pcd(folder / "clouds/row.pcd", row);
  const Measurement measurement = read("0,0,3,5,0,10,water,20,300,0,clouds/row.pcd\n");
  EXPECT_TRUE(find(measurement, "log_brightness", "interior"));
  EXPECT_FALSE(find(measurement, "log_ir_contrast", "interior"));
}

TEST_F(MeasurementFolder, RefusesInfraredImagesThatDoNotFit) {
  write_png(folder / "ir.png", Image<std::uint16_t>(100, 100));
  expect_refused("0,0,3,5,0,10,water,20,300,0,clouds/a.pcd,ir.png\n", "line 2", kHeader + ",ir");
  expect_refused("0,0,3,5,0,10,water,20,300,0,clouds/a.pcd,none.png\n", "line 2", kHeader + ",ir");
}

TEST_F(MeasurementFolder, HeightsAreThoseOfTheRegionsOverTheTrials) {
  const Measurement measurement = read(
      "0,0,3,5,0,10,water,20,300,0,clouds/a.pcd\n"
      "1,0,3,5,1,14,water,20,300,0,clouds/b.pcd\n");
  constexpr double kRounding = 2e-3;  // mm: clouds are of floats, and pixels step over a region's border
  for (const char* region : {"centre", "near", "far", "left", "right"}) {
    const Observation* height = find(measurement, "height_mm", region);
    ASSERT_TRUE(height) << region;
    EXPECT_NEAR(height->value, 21.0, kRounding) << region;
    EXPECT_NEAR(height->repeat_sd, std::sqrt(2.0), kRounding) << region;
    EXPECT_EQ(height->repeats, 2);
    EXPECT_EQ(height->factors.time_s, 12.0);
    EXPECT_EQ(height->factors.pour, 3);
    EXPECT_EQ(height->factors.placement, 5);
  }
  EXPECT_NEAR(find(measurement, "desk_height_mm", "desk")->value, 650.5, kRounding);
  EXPECT_NEAR(find(measurement, "desk_pitch_deg", "desk")->value, kPitchDeg, 1e-4);
  EXPECT_NEAR(find(measurement, "desk_roll_deg", "desk")->value, 0.0, 1e-4);
  EXPECT_NEAR(find(measurement, "desk_residual_mm", "middle")->value, 0.0, kRounding);
  EXPECT_NEAR(find(measurement, "log_brightness", "interior")->value, 0.0, 1e-6);
  EXPECT_LT(find(measurement, "comb_strength", "desk")->value, 0.05);  // even depths have no comb
}

TEST_F(MeasurementFolder, AThinnedCloudSaysWhatTheWholeOneDoes) {
  // A bowl, which no plane fits: where it is fitted decides what is said of it.
  Image<CloudPoint> whole = ideal_cloud(kHeight, 0.020);
  for (CloudPoint& p : whole.pixels()) {
    const float bent = 1.0f + 0.01f * (p.x * p.x + p.y * p.y) / (p.z * p.z);
    p = {bent * p.x, bent * p.y, bent * p.z, p.intensity};
  }
  std::vector<CloudPoint> kept;
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      const bool is_near_cup = x > 250 && x < 450 && y > 220 && y < 420;
      const int stride = is_near_cup ? 2 : 12;
      if (x % stride == 0 && y % stride == 0) kept.push_back(whole(x, y));
    }
  Image<CloudPoint> thinned(static_cast<int>(kept.size()), 1);
  std::copy(kept.begin(), kept.end(), thinned.pixels().begin());
  write_pcd(folder / "clouds/whole.pcd", whole);
  write_pcd(folder / "clouds/thinned.pcd", thinned);
  const Measurement measurement = read(
      "0,0,0,0,0,0,water,20,300,0,clouds/whole.pcd\n"
      "1,0,0,1,0,9,water,20,300,0,clouds/thinned.pcd\n");
  const auto value_of = [&](int placement, const char* observable, const char* region) {
    for (const Observation& o : measurement.observations)
      if (o.factors.placement == placement && o.observable == observable && o.factors.region == region) return o.value;
    return std::nan("");
  };
  // mm; every 12th pixel ends up to 11 before the image does, where the bowl rises by 0.2. If each point counted alike,
  // the desk would lie 0.7 nearer.
  constexpr double kEdges = 0.1;
  EXPECT_NEAR(value_of(0, "desk_height_mm", "desk"), value_of(1, "desk_height_mm", "desk"), kEdges);
  EXPECT_NEAR(value_of(0, "height_mm", "far"), value_of(1, "height_mm", "far"), kEdges);
  for (const char* region : {"top", "middle", "bottom", "top left", "bottom right"})
    EXPECT_NEAR(value_of(0, "desk_residual_mm", region), value_of(1, "desk_residual_mm", region), kEdges) << region;
}

TEST_F(MeasurementFolder, APourHasStoodSinceItsFirstFrame) {
  const Measurement measurement = read(
      "0,0,0,0,0,0,none,0,0,0,clouds/a.pcd\n"
      "1,0,0,0,0,90,water,20,300,0,clouds/a.pcd\n"
      "2,0,0,1,0,120,water,20,300,0,clouds/b.pcd\n"
      "3,0,1,2,0,210,water,20,300,0,clouds/a.pcd\n"
      "4,1,0,3,0,30,water,20,300,0,clouds/b.pcd\n");
  const double expected_s[] = {0.0, 0.0, 30.0, 0.0, 0.0};
  for (std::size_t i = 0; i < std::size(expected_s); ++i) EXPECT_EQ(measurement.frames[i].stood_s, expected_s[i]) << i;
  double longest_s = 0.0;
  for (const Observation& o : measurement.observations) longest_s = std::max(longest_s, o.factors.stood_s);
  EXPECT_EQ(longest_s, 30.0);
}

TEST_F(MeasurementFolder, RegionsAreTurnedAsTheirNamesSay) {
  const Measurement measurement = read("0,0,0,0,0,0,water,20,300,0,clouds/tilted.pcd\n");
  // Rises by a tenth away from the sensor: the sectors' centroids are 21.0 mm from the axis.
  constexpr double kPixels = 0.15;  // mm: a pixel is 1.3 mm, a sector some 20 wide
  EXPECT_NEAR(find(measurement, "height_mm", "far")->value, 22.1, kPixels);
  EXPECT_NEAR(find(measurement, "height_mm", "near")->value, 17.9, kPixels);
  EXPECT_NEAR(find(measurement, "height_mm", "left")->value, 20.0, kPixels);
  EXPECT_NEAR(find(measurement, "height_mm", "right")->value, 20.0, kPixels);
}

TEST_F(MeasurementFolder, CopiesOfTrialsDoNotCountAndAreSaid) {
  const std::string different = "0,0,0,0,0,0,water,20,300,0,clouds/a.pcd\n1,0,0,0,1,1,water,20,300,0,clouds/b.pcd\n",
                    alike = "2,0,1,1,0,2,water,20,300,0,clouds/a.pcd\n3,0,1,1,1,3,water,20,300,0,clouds/a.pcd\n";
  const Measurement measurement = read(different + alike);
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].id, "duplicated_trial");
  EXPECT_EQ(measurement.mistakes[0].sentence, "2 of 4 frames are copies of others.");
  for (const Observation& observation : measurement.observations) EXPECT_EQ(observation.factors.placement, 0);
  EXPECT_EQ(measurement.observations.front().repeats, 2);
  // Where all trials are alike there is no noise, and where all pours are there are no other errors.
  EXPECT_TRUE(read(alike).mistakes.empty());
  EXPECT_TRUE(
      read("0,0,0,0,0,0,water,20,300,0,clouds/a.pcd\n1,0,1,1,0,9,water,20,300,0,clouds/a.pcd\n").mistakes.empty());
}

TEST_F(MeasurementFolder, WhereEveryTrialIsACopyTheDeskTellsNoiseFromNone) {
  const std::string rows =
      "0,0,0,0,0,0,water,20,300,0,clouds/low.pcd\n1,0,0,0,1,1,water,20,300,0,clouds/low.pcd\n"
      "2,0,1,1,0,2,water,30,300,0,clouds/high.pcd\n3,0,1,1,1,3,water,30,300,0,clouds/high.pcd\n";
  const auto write_clouds = [&](double noise) {
    for (const auto& [name, disc] : {std::pair("low", 0.020), std::pair("high", 0.030)}) {
      Image<CloudPoint> cloud = ideal_cloud(kHeight, disc);
      Rng rng(1, static_cast<int>(1000 * disc));
      for (CloudPoint& point : cloud.pixels()) {
        const auto longer = static_cast<float>(1.0 + noise * (rng.uniform() - 0.5));
        point.x *= longer, point.y *= longer, point.z *= longer;
      }
      write_pcd(folder / fmt::format("clouds/{}.pcd", name), cloud);
    }
  };
  write_clouds(0.0);
  EXPECT_TRUE(read(rows).mistakes.empty());
  write_clouds(1e-3);
  const Measurement measurement = read(rows);
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].sentence, "2 of 4 frames are copies of others.");
  EXPECT_EQ(measurement.observations.front().repeats, 1);
}

TEST_F(MeasurementFolder, ACloudThatStandsForTwoConditionsCountsForNeither) {
  fs::copy(folder / "clouds/b.pcd", folder / "clouds/copied.pcd");
  const Measurement measurement = read(
      "a1,0,0,0,0,0,water,20,300,0,clouds/a.pcd\n"
      "b1,0,1,1,0,9,water,30,300,0,clouds/b.pcd\n"
      "b2,0,2,2,0,18,empty,0,300,0,clouds/copied.pcd\n");
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].sentence,
            "Frames b1 and b2 have the same cloud, but another liquid, fill or place: none of them counts.");
  for (const Observation& observation : measurement.observations) EXPECT_EQ(observation.factors.placement, 0);
}

TEST_F(MeasurementFolder, CopiedRowsOfATableAreFoundWhereChanceWouldNotMakeThem) {
  int next = 0;
  const auto rows = [&](std::initializer_list<const char*> trials) {
    std::string text;
    for (const char* trial : trials) text += fmt::format("{0},0,0,0,{0},0,water,20,300,0,,{1}\n", next++, trial);
    return text;
  };
  const std::string header = kHeader + ",height_mm,height_sd_mm,points";
  const auto first = {"15.1,0.8,900", "15.3,0.7,902", "15.2,0.8,899"};
  const std::string once = rows(first);
  EXPECT_TRUE(read(once, header).mistakes.empty());
  EXPECT_TRUE(read(once + rows({"15.1,0.8,900", "15.4,0.9,901", "15.0,0.8,903"}), header).mistakes.empty());
  const Measurement twice = read(once + rows(first), header);
  ASSERT_EQ(twice.mistakes.size(), 1u);
  EXPECT_EQ(twice.mistakes[0].sentence, "3 of 6 frames are copies of others.");
  EXPECT_EQ(twice.observations.back().repeats, 3);
}

TEST_F(MeasurementFolder, ACopiedFolderIsRefusedAndAnotherOfTheSamePlanIsNot) {
  const std::string header = kHeader + ",height_mm,height_sd_mm,points\n";
  const auto rows = [&](std::uint64_t seed) {
    std::string text = header;
    for (int i = 0; i < 40; ++i) {
      Rng rng(seed, i);
      text += fmt::format("{0},0,0,0,{0},{0},water,20,300,0,,{1:.0f},{2:.1f},{3}\n", i, 15.0 + 0.2 * rng.normal(),
                          0.7 + 0.1 * rng.normal(), 900 + static_cast<int>(5.0 * rng.normal()));
    }
    return text;
  };
  write_text(folder / "frames.csv", rows(1));
  make_directory(folder / "more");
  fs::copy(folder / "rig.json", folder / "more/rig.json");
  const std::array<fs::path, 2> folders{folder / "", folder / "more"}, other_way{folder / "more", folder / ""};
  write_text(folder / "more/frames.csv", rows(2));
  EXPECT_NO_THROW(read_measurements(folders));
  // A copy that the laboratory went on with is one in either order.
  write_text(folder / "more/frames.csv", rows(1) + "40,1,1,1,0,0,water,20,300,0,,15,0.7,900\n");
  expect_error([&] { read_measurements(folders); },
               {"more: must be another measurement than ", "40 of its 41 frames are the same"});
  expect_error([&] { read_measurements(other_way); }, {"40 of its 40 frames are the same"});
}

/// Clouds of a sensor without noise are the same in every campaign of one plan.
TEST(Copies, OfCloudsAreToldFromASensorWithoutNoise) {
  std::vector<FrameRecord> frames(12);
  const auto prints = [&](std::uint64_t seed, bool has_noise) {
    std::vector<CloudPrint> all(frames.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].whole = mix_bits(seed) + i;
      for (std::size_t part = 0; part < all[i].parts.size(); ++part)
        all[i].parts[part] = has_noise ? mix_bits(100 * i + part) : part + 1;
    }
    return all;
  };
  EXPECT_EQ(rows_repeated(frames, prints(1, true), frames, prints(1, true)), 12u);
  EXPECT_EQ(rows_repeated(frames, prints(2, true), frames, prints(1, true)), 0u);
  EXPECT_EQ(rows_repeated(frames, prints(1, false), frames, prints(1, false)), 0u);
}

/// Two sessions of bare desks that are alike, and two cups that are not; of each placement two trials.
TEST(Copies, OfASensorWithoutNoiseMayBeOfSeveralSessions) {
  std::vector<FrameRecord> frames(8);
  std::vector<CloudPrint> prints(8);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].session = frames[i].placement = static_cast<int>(i / 4);
    frames[i].trial = static_cast<int>(i % 2);
    const bool is_bare = i % 4 < 2;
    frames[i].liquid = is_bare ? "none" : "water";
    frames[i].distance_m = is_bare ? 0.0 : 0.3;
    prints[i].whole = is_bare ? 1 : 2 + i / 4;
    prints[i].parts.fill(1);
  }
  EXPECT_TRUE(find_copies(frames, prints).mistakes.empty());
}

TEST_F(MeasurementFolder, RowsOfFewPointsOnTheStepsOfDepthAreNoCopies) {
  // Six points on two or three steps of depth: the desk moves the height, which is rounded, and not the spread.
  constexpr std::array kSpreads{0.027, 0.592, 0.586, 0.108, 0.702};
  std::string rows;
  for (int i = 0; i < 100; ++i) {
    Rng rng(3, i);
    const double spread = kSpreads[static_cast<std::size_t>(kSpreads.size() * rng.uniform())];
    const double height = 9.2 + 0.5 * spread + i / 10 + 0.1 * (rng.uniform() - 0.5);
    rows += fmt::format("{0},0,0,{1},{2},0,water,20,300,0,,{3:.1f},{4:.3f},6\n", i, i / 10, i % 10, height, spread);
  }
  const Measurement measurement = read(rows, kHeader + ",height_mm,height_sd_mm,points");
  EXPECT_TRUE(measurement.mistakes.empty());
  EXPECT_EQ(measurement.observations.front().repeats, 10);
}

TEST_F(MeasurementFolder, HeightsKnowWhatTheyAreRoundedTo) {
  const auto rounding = [&](std::initializer_list<const char*> heights) {
    std::string rows;
    int next = 0;
    for (const char* height : heights) rows += fmt::format("{0},0,0,0,{0},{0},water,20,300,0,,{1}\n", next++, height);
    return read(rows, kHeader + ",height_mm").observations.front().rounding;
  };
  EXPECT_DOUBLE_EQ(rounding({"15", "16", "15"}), 1.0 / std::sqrt(12.0));
  EXPECT_DOUBLE_EQ(rounding({"15.5", "16.0", "15.0"}), 0.5 / std::sqrt(12.0));
  EXPECT_DOUBLE_EQ(rounding({"15.3", "16.0", "15.2"}), 0.1 / std::sqrt(12.0));
  EXPECT_EQ(rounding({"15.31", "16.02", "15.27"}), 0.0);
}

TEST_F(MeasurementFolder, AMirroredAxisIsPutRight) {
  // The disc stands at 75 mm: 37.5 mm of it is the camera's place.
  const auto at = [](double lateral) {
    const double pitch = radians_from_deg(kPitchDeg);
    Image<CloudPoint> cloud = ideal_cloud(kHeight, 0.0);
    for (int y = 0; y < 480; ++y)
      for (int x = 0; x < 640; ++x) {
        const double u = (x + 0.5 - 320.0) / kFocal, v = (y + 0.5 - 240.0) / kFocal;
        const double z = (kHeight - 0.020) / (std::sin(pitch) + v * std::cos(pitch));
        const double ahead = z * (std::cos(pitch) - v * std::sin(pitch));
        if (std::hypot(z * u - 0.0375 - lateral, ahead - 0.3) < 0.040)
          cloud(x, y) = {static_cast<float>(z * u), static_cast<float>(z * v), static_cast<float>(z), 100.0f};
      }
    return cloud;
  };
  write_pcd(folder / "clouds/right.pcd", at(0.1));
  write_pcd(folder / "clouds/left.pcd", at(-0.1));
  std::string rows;
  for (int i = 0; i < 4; ++i)
    rows += fmt::format("{},0,0,{},{},{},water,20,300,{},clouds/{}.pcd\n", i, i % 2, i / 2, i, i % 2 ? -100 : 100,
                        i % 2 ? "right" : "left");
  const Measurement measurement = read(rows);
  ASSERT_EQ(measurement.mistakes.size(), 1u);
  EXPECT_EQ(measurement.mistakes[0].id, "flipped_axis");
  EXPECT_EQ(measurement.observations.front().factors.lateral_mm, -100.0);
  ASSERT_TRUE(find(measurement, "height_mm", "centre"));
  EXPECT_NEAR(find(measurement, "height_mm", "centre")->value, 20.0, 0.01);  // mm: the desk's fit sees the disc's edge
}

TEST_F(MeasurementFolder, ABareDeskHasNoCup) {
  const Measurement measurement = read("0,0,0,0,0,0,none,0,0,0,clouds/a.pcd\n");
  EXPECT_TRUE(find(measurement, "desk_height_mm", "desk"));
  EXPECT_FALSE(find(measurement, "height_mm", "centre"));
}

/// Nothing is put down there that a laboratory would number.
TEST_F(MeasurementFolder, ABareDeskIsViewedAnewWhereTrialsBeginAnewOrACupStoodThere) {
  double height = kHeight;
  for (const char* cloud : {"clouds/c.pcd", "clouds/d.pcd", "clouds/e.pcd", "clouds/f.pcd"})
    write_pcd(folder / cloud, ideal_cloud(height -= 0.0007, 0.020));
  const Measurement measurement = read(
      "0,0,0,0,0,10,none,0,0,0,clouds/a.pcd\n1,0,0,0,1,12,none,0,0,0,clouds/b.pcd\n"
      "2,0,0,0,0,900,none,0,0,0,clouds/c.pcd\n3,0,0,0,1,902,none,0,0,0,clouds/d.pcd\n"
      "4,1,0,5,0,10,none,0,0,0,clouds/e.pcd\n5,1,0,0,0,20,empty,0,300,0,clouds/tilted.pcd\n"
      "6,1,0,5,0,30,none,0,0,0,clouds/f.pcd\n");
  std::vector<std::tuple<int, int, double>> views;
  for (const Observation& o : measurement.observations)
    if (o.observable == "desk_height_mm" && o.factors.liquid == "none")
      views.emplace_back(o.factors.session, o.factors.placement, o.factors.time_s);
  EXPECT_EQ(views,
            (std::vector<std::tuple<int, int, double>>{{0, 0, 11.0}, {0, 1, 901.0}, {1, 0, 10.0}, {1, 1, 30.0}}));
}

TEST_F(MeasurementFolder, ATableOfHeightsWorksAndSaysWhatItLacks) {
  const Measurement measurement =
      read("0,0,0,0,0,0,water,20,300,0,,12.5\n1,0,0,0,1,1,water,20,300,0,,12.7\n", kHeader + ",height_mm");
  ASSERT_EQ(measurement.observations.size(), 1u);
  EXPECT_EQ(measurement.observations[0].factors.region, "interior");
  EXPECT_NEAR(measurement.observations[0].value, 12.6, 1e-12);
  ASSERT_EQ(measurement.notes.size(), 1u);
  EXPECT_EQ(measurement.notes[0].rfind("2 of 2 frames have a height and no cloud", 0), 0u);
}

/// A laboratory that wrote down heights need not name clouds that it has not.
TEST_F(MeasurementFolder, ATableOfHeightsNeedsNoColumnForClouds) {
  const std::string header =
      "frame,session,pour,placement,trial,time_s,liquid,fill_mm,distance_mm,lateral_mm,height_mm";
  const Measurement measurement = read("0,0,0,0,0,0,water,20,300,0,12.5\n1,0,0,0,1,1,none,0,0,0,\n", header);
  ASSERT_EQ(measurement.observations.size(), 1u);
  EXPECT_EQ(measurement.observations[0].value, 12.5);
  expect_refused("0,0,0,0,0,0,water,20,300,0,12.5\n1,0,0,0,1,1,water,20,300,0,\n",
                 "line 3, column 'height_mm': is empty, and there is no cloud in its place", header);
  expect_refused("0,0,0,0,0,0,water,20,300,0\n",
                 "line 1: has neither a column 'cloud' nor a column 'height_mm', one of them is needed",
                 header.substr(0, header.rfind(',')));
}

TEST_F(MeasurementFolder, WhatShowsTheDeskInPlaceOfItsCupDoesNotCount) {
  const std::string right = "0,0,0,0,0,0,water,20,300,0,clouds/a.pcd\n1,0,0,0,1,1,water,20,300,0,clouds/b.pcd\n";
  const Measurement measurement = read(right + "beside,0,0,1,0,9,water,20,300,150,clouds/tilted.pcd\n");
  ASSERT_EQ(measurement.notes.size(), 1u);
  EXPECT_EQ(measurement.notes[0],
            "1 of 3 clouds show the bare desk where distance_mm and lateral_mm say the cup is and do not count: frame "
            "beside");
  for (const Observation& observation : measurement.observations) EXPECT_EQ(observation.factors.placement, 0);
}

TEST_F(MeasurementFolder, MistakesGetOneLineEach) {
  expect_refused("", "has no frames below its header");
  expect_refused("0,0\n", "line 1: has no column 'session', only frame,liquid", "frame,liquid");
  expect_refused("0,0,0,0,0,0,wine,0,300,0,clouds/a.pcd\n",
                 "line 2, column 'liquid': unknown liquid 'wine', choose from empty, none, water");
  expect_refused("0,0,0.5,0,0,0,water,0,300,0,clouds/a.pcd\n",
                 "line 2, column 'pour': must be a whole number from 0, got '0.5'");
  expect_refused("0,0,0,0,0,0,water,0,300,0,clouds/none.pcd\n", "line 2, column 'cloud': there is no file ");
  expect_refused("0,0,0,0,0,0,water,20,0.3,0,clouds/a.pcd\n",
                 "line 2, column 'distance_mm': must be in mm and, with lateral_mm 0, where the sensor, 650 mm high "
                 "and pitched down by 58.4 degrees, sees the cup, got '0.3'");
  expect_refused("0,0,0,0,0,0,water,200,300,0,clouds/a.pcd\n",
                 "line 2, column 'fill_mm': must be from 0 to 80, the depth of the cup, got '200'");
  expect_refused("0,0,0,0,0,0,water,20,300,0,,nan\n", "line 2, column 'height_mm': must be a finite number, got 'nan'",
                 kHeader + ",height_mm");
  expect_refused("0,0,0,0,0,0,water,20,300,0,clouds/a.pcd\n1,0,0,0,1,1,water,20,300,0,clouds/mm.pcd\n",
                 "line 3, column 'cloud': " + (folder / "clouds/mm.pcd").string() +
                     ": must be in metres: most of its points lie more than 50 away");
  expect_refused(
      "0,0,0,0,0,0,water,20,300,150,clouds/a.pcd\n",
      "line 2, column 'distance_mm': 1 of 1 clouds show the bare desk where distance_mm and lateral_mm say the cup is, "
      "must be the places of the cup's axis in mm");
  write_pcd(folder / "clouds/lower.pcd", ideal_cloud(1.2 * kHeight, 0.020));
  expect_refused(
      "0,0,0,0,0,0,water,20,300,0,clouds/lower.pcd\n",
      "line 2, column 'cloud': 1 of 1 clouds show no desk where rig.json says it is, must be in metres in the "
      "camera's frame: x right, y down, z forward");
  write_text(folder / "clouds/bad.pcd", "hello\n");
  expect_refused("0,0,0,0,0,0,water,20,300,0,clouds/bad.pcd\n",
                 "line 2, column 'cloud': " + (folder / "clouds/bad.pcd").string() + ": is neither PCD nor PLY");
}

TEST_F(MeasurementFolder, AHeightMayBeNoiseWhereThoseOfItsFillingArePossible) {
  const std::string header = kHeader + ",height_mm";
  const std::string noisy =
      "0,0,0,0,0,0,empty,0,300,0,,-0.4\n1,0,0,0,1,1,empty,0,300,0,,6.9\n2,0,0,0,2,2,empty,0,300,0,,8.1\n";
  EXPECT_NEAR(read(noisy, header).observations.front().value, 14.6 / 3.0, 1e-9);
  expect_refused(noisy + "3,0,0,0,3,3,empty,0,300,0,,125\n",
                 "line 5, column 'height_mm': must be in mm above the desk, from 1.75 to 92 in this cup, got '125'",
                 header);
  expect_refused(noisy + "3,0,1,1,0,3,water,20,300,0,,1.3\n4,0,1,1,1,4,water,20,300,0,,1.4\n",
                 "line 5, column 'height_mm': must be in mm above the desk, from 1.75 to 92 in this cup, got '1.3'",
                 header);
}

TEST_F(MeasurementFolder, RowsMustBePossible) {
  const std::pair<const char*, const char*> rows[] = {
      {"0,may,0,0,0,0,water,20,300,0,,15", "line 2, column 'session': must be a whole number from 0, got 'may'"},
      {"0,0,,0,0,0,water,20,300,0,,15", "line 2, column 'pour': must be a whole number from 0, got ''"},
      {"0,0,0,0,0,0,none,20,0,0,,", "line 2, column 'fill_mm': must be 0 where the liquid is none, got '20'"},
      {"0,0,0,0,0,0,empty,20,300,0,,7", "line 2, column 'fill_mm': must be 0 where the liquid is empty, got '20'"},
      {"0,0,0,0,0,0,water,20,30,0,,15",
       "line 2, column 'distance_mm': must be in mm and, with lateral_mm 0, where the sensor, 650 mm high "
       "and pitched down by 58.4 degrees, sees the cup, got '30'"},
      {"0,0,0,0,0,0,water,20,300,-5000,,15",
       "line 2, column 'distance_mm': must be in mm and, with lateral_mm -5000, where the sensor, 650 mm "
       "high and pitched down by 58.4 degrees, sees the cup, got '300'"},
      {"0,0,0,0,0,0,water,20,300,0,,1.5",
       "line 2, column 'height_mm': must be in mm above the desk, from 1.75 to 92 in this cup, got '1.5'"},
      {"0,0,0,0,0,0,water,20,300,0,,15\n0,0,0,0,1,1,water,20,300,0,,15",
       "line 3, column 'frame': must be another one for every frame of a session, got '0' again"},
      {"0,0,0,0,0,9,water,20,300,0,,15\n1,0,0,0,1,8,water,20,300,0,,15",
       "line 3, column 'time_s': must not run backwards over the trials of a placement, got '8'"}};
  for (const auto& [row, what] : rows) expect_refused(row, what, kHeader + ",height_mm");
}

}  // namespace
}  // namespace fathom
