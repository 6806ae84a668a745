// Desks that one Kinect v1 measured, each predicted from all the others. The clouds are no part of the project.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <numeric>

#include "detector/read_cloud.h"
#include "diagnosis/unit/bias_learner.h"
#include "diagnosis/unit/calibration_view.h"
#include "diagnosis/unit/desk_difference.h"
#include "diagnosis/unit/local_bias.h"

namespace fathom {
namespace real_desks_test {

constexpr DeviceScale kKinect{.focal_px = 575.816, .baseline_m = 0.075, .camera_m = 0.025, .cut_m = 1e-3};
constexpr int kWidth = 640, kHeight = 480;

struct Desk {
  std::string name;
  Points points;  ///< organised
  CalibrationView seen;
};

std::vector<Desk> desks() {
  const char* named = std::getenv("FATHOM_REAL_DATA");
  const std::filesystem::path data = named ? named : FATHOM_REAL_DATA_DEFAULT;
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"mOSD", "mOSD_more"})
    if (std::filesystem::exists(data / folder))
      for (const auto& entry : std::filesystem::directory_iterator(data / folder))
        if (entry.path().extension() == ".pcd") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Desk> all;
  for (const std::filesystem::path& file : files) {
    Desk desk{file.stem().string(), read_cloud(file).points, {}};
    Points some;
    for (std::size_t i = 0; i < desk.points.size(); i += 7)
      if (desk.points[i].allFinite()) some.push_back(desk.points[i]);
    const auto plane = choose_desk(find_planes(some, {}), std::nullopt, {});
    auto view = plane ? desk_view({&desk.points, 1}, plane->plane, kKinect) : std::nullopt;
    if (!view) ADD_FAILURE() << "no desk in " << file;
    if (view) desk.seen = std::move(*view);
    all.push_back(std::move(desk));
  }
  return all;
}

/// Root mean square of the desk's residuals, apart from a plane, smoothed by a Gaussian of 8 px.
double smooth_rms(const Desk& desk, const std::function<double(const Eigen::Vector3f&)>& bias_px) {
  constexpr double kWithin_px = 0.5, kSigma_px = 8.0;
  constexpr int kReach = 24;
  const double product = kKinect.focal_px * kKinect.baseline_m;
  const Eigen::Vector3d plane = -desk.seen.plane.normal / desk.seen.plane.offset * product;
  std::vector<double> error(desk.points.size()), weight(desk.points.size());
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto at = [](const Eigen::Vector3f& p) { return Eigen::Vector3d(p.x() / p.z(), p.y() / p.z(), 1.0); };
  for (std::size_t i = 0; i < error.size(); ++i) {
    const Eigen::Vector3f& point = desk.points[i];
    if (!point.allFinite()) continue;
    error[i] = kKinect.disparity_px(point.z()) - plane.dot(at(point));
    if (std::abs(error[i]) > kWithin_px) continue;
    weight[i] = 1.0;
    error[i] -= bias_px(point);
    normal += at(point) * at(point).transpose();
    right += error[i] * at(point);
  }
  const Eigen::Vector3d rest = normal.ldlt().solve(right);
  for (std::size_t i = 0; i < error.size(); ++i)
    error[i] = weight[i] > 0.0 ? error[i] - rest.dot(at(desk.points[i])) : 0.0;
  const auto smoothed = [&](std::vector<double> image) {
    std::vector<double> kernel;
    for (int k = -kReach; k <= kReach; ++k) kernel.push_back(std::exp(-0.5 * std::pow(k / kSigma_px, 2.0)));
    for (const bool rows : {true, false}) {
      std::vector<double> next(image.size());
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          for (int k = -kReach; k <= kReach; ++k) {
            const int u = rows ? x + k : x, v = rows ? y : y + k;
            if (u >= 0 && u < kWidth && v >= 0 && v < kHeight)
              next[y * kWidth + x] += kernel[k + kReach] * image[v * kWidth + u];
          }
      image = std::move(next);
    }
    return image;
  };
  const std::vector<double> sums = smoothed(error), weights = smoothed(weight);
  double squares = 0.0, pixels = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (weight[i] > 0.0) squares += std::pow(sums[i] / weights[i], 2.0), pixels += 1.0;
  return std::sqrt(squares / pixels);
}

/// The plain mean of the views' errors, square by square [px]; 0 where none has desk.
class MeanOfViews {
 public:
  explicit MeanOfViews(const std::vector<BiasView>& views) : sums_(kColumns * kRows), counts_(kColumns * kRows) {
    for (const BiasView& view : views)
      for (std::size_t i = 0; i < view.cells.size(); ++i) {
        const std::size_t square = square_of({view.cells[i].column_px, view.cells[i].row_px});
        sums_[square] += view.errors_px[i], counts_[square] += 1.0;
      }
  }
  double at(const Eigen::Vector2d& pixel_px) const {
    const std::size_t square = square_of(pixel_px);
    return counts_[square] > 0.0 ? sums_[square] / counts_[square] : 0.0;
  }

 private:
  static constexpr int kColumns = static_cast<int>(kWidth / kBiasCell_px),
                       kRows = static_cast<int>(kHeight / kBiasCell_px);
  static std::size_t square_of(const Eigen::Vector2d& pixel_px) {
    const double column = std::clamp(std::floor(pixel_px.x() / kBiasCell_px), 0.0, kColumns - 1.0),
                 row = std::clamp(std::floor(pixel_px.y() / kBiasCell_px), 0.0, kRows - 1.0);
    return static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column);
  }
  std::vector<double> sums_, counts_;
};

/// What of desks' errors is left, in the mean over every so many desks, each predicted from all others.
struct Left {
  double with_the_pose = 0.0, without = 0.0, of_the_plain_mean = 0.0;
};
Left left_of_desks(const std::vector<Desk>& all, std::size_t every) {
  std::vector<BiasView> views;
  for (const Desk& desk : all) views.push_back(desk.seen.view);
  set_states_by_pose(views);
  const double at_reference = kKinect.focal_px * kKinect.baseline_m / kReferenceDistance_m;
  const double count = std::ceil(static_cast<double>(all.size()) / static_cast<double>(every));
  double size = 0.0, share = 0.0, without_states = 0.0, by_mean = 0.0;
  for (std::size_t left_out = 0; left_out < all.size(); left_out += every) {
    std::vector<BiasView> others = views;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    const BiasPrior prior = learned_bias_prior(others);
    const BiasField field = BiasLearner(others, prior).learn();
    const double before = smooth_rms(all[left_out], [](const Eigen::Vector3f&) { return 0.0; });
    const auto left = [&](int state) {
      return smooth_rms(
                 all[left_out],
                 [&](const Eigen::Vector3f& point) {
                   return field.at({kKinect.pixel_px(point), kKinect.disparity_px(point.z()) - at_reference, state});
                 }) /
             before;
    };
    const MeanOfViews mean(others);
    by_mean +=
        smooth_rms(all[left_out], [&](const Eigen::Vector3f& point) { return mean.at(kKinect.pixel_px(point)); }) /
        before / count;
    size += before / count;
    share += left(views[left_out].state) / count;
    without_states += left(kNoState) / count;
  }
  testing::Test::RecordProperty("before_px", std::to_string(size));
  testing::Test::RecordProperty("left_by_the_plain_mean", std::to_string(by_mean));
  testing::Test::RecordProperty("left_with_the_pose", std::to_string(share));
  testing::Test::RecordProperty("left_of_other_poses", std::to_string(without_states));
  return {share, without_states, by_mean};
}

TEST(RealDesks, ABiasLearnedOnSomeDesksIsTakenOffOthers) {
  const std::vector<Desk> all = desks();
  if (all.size() < 21) GTEST_SKIP() << "the clouds of mOSD and mOSD_more are absent: see FATHOM_REAL_DATA";
  const Left left = left_of_desks(all, 4);
  EXPECT_LE(left.with_the_pose, 0.5);
  EXPECT_LE(left.with_the_pose, left.of_the_plain_mean);
}

/// docs/calibrate.md gives these numbers, which take five minutes: --gtest_also_run_disabled_tests.
TEST(RealDesks, DISABLED_ABiasIsTakenOffEachDesk) {
  const std::vector<Desk> all = desks();
  ASSERT_GE(all.size(), 21) << "the clouds of mOSD and mOSD_more are absent: see FATHOM_REAL_DATA";
  const Left left = left_of_desks(all, 1);
  EXPECT_LE(left.with_the_pose, 0.38);
  EXPECT_LE(left.without, 0.45);
  EXPECT_LE(left.with_the_pose, left.of_the_plain_mean);
}

/// Scenes of one pose stand for sessions of one unit. Whatever a part of them is off by, up to what things do that lie
/// on one desk and not on the other, two views' own errors explain.
TEST(RealDesks, PartsOfOneDeskDifferByNoMoreThanIsThoughtOfSessions) {
  constexpr double kThing_px = 0.2;  // 1.3 mm of height, 0.65 m away
  const std::vector<Desk> all = desks();
  if (all.size() < 21) GTEST_SKIP() << "the clouds of mOSD and mOSD_more are absent: see FATHOM_REAL_DATA";
  std::vector<BiasView> views;
  for (const Desk& desk : all) views.push_back(desk.seen.view);
  set_states_by_pose(views);
  struct Size {
    double found_px2 = 0.0, expected_px2 = 0.0, count = 0.0;
  };
  std::map<std::pair<double, double>, Size> sizes;
  int with_things = 0, without = 0, differ = 0;
  for (std::size_t one = 0; one < views.size(); ++one)
    for (std::size_t other = one + 1; other < views.size(); ++other) {
      if (views[one].state != views[other].state) continue;
      const std::vector<DeskDifference> parts = desk_parts({{0, views[one]}, {1, views[other]}}, 1);
      double largest_px = 0.0;
      for (const DeskDifference& part : parts) {
        largest_px = std::max(largest_px, std::abs(part.bias_px));
        if (std::abs(part.bias_px) > kThing_px) continue;
        Size& size = sizes[{part.size_px.x(), part.size_px.y()}];
        size.found_px2 += part.bias_px * part.bias_px;
        size.expected_px2 += part.sigma_px * part.sigma_px;
        size.count += 1.0;
      }
      ++(largest_px > kThing_px ? with_things : without);
      if (largest_px <= kThing_px) differ += desk_differences({{0, views[one]}, {1, views[other]}}).front().p() < 3e-4;
    }
  RecordProperty("pairs_with_things", with_things);
  RecordProperty("pairs_without", without);
  EXPECT_GE(without, 30);
  EXPECT_EQ(differ, 0);
  for (const auto& [size, of] : sizes) {
    if (of.count < 100.0) continue;
    RecordProperty("found_px_" + std::to_string(static_cast<int>(size.first)) + "x" +
                       std::to_string(static_cast<int>(size.second)),
                   std::to_string(std::sqrt(of.found_px2 / of.count)));
    EXPECT_LE(of.found_px2, of.expected_px2) << size.first << " x " << size.second << " px";
  }
}

/// A Kinect's bias has no place that differs from the rest as a smear does.
TEST(RealDesks, NoPlaceOfADevicesBiasStandsOut) {
  const std::vector<Desk> all = desks();
  if (all.size() < 21) GTEST_SKIP() << "the clouds of mOSD and mOSD_more are absent: see FATHOM_REAL_DATA";
  std::vector<BiasView> views;
  for (const Desk& desk : all) views.push_back(desk.seen.view);
  set_states_by_pose(views);
  std::map<int, std::map<std::pair<double, double>, std::pair<BiasCell, std::vector<double>>>> poses;
  std::map<int, std::size_t> scenes;
  for (const BiasView& view : views) {
    ++scenes[view.state];
    for (std::size_t i = 0; i < view.cells.size(); ++i) {
      auto& [cell, errors] = poses[view.state][{view.cells[i].row_px, view.cells[i].column_px}];
      cell = view.cells[i];
      errors.push_back(view.errors_px[i]);
    }
  }
  for (const auto& [pose, cells] : poses) {
    BiasView mean;  // what at least half of the scenes show: things on the desks are elsewhere each time
    for (const auto& [at, seen] : cells) {
      if (2 * seen.second.size() < scenes[pose]) continue;
      mean.cells.push_back(seen.first);
      mean.errors_px.push_back(std::accumulate(seen.second.begin(), seen.second.end(), 0.0) /
                               static_cast<double>(seen.second.size()));
    }
    const BiasLearner learner({&mean, 1}, bias_prior_of(mean, default_bias_prior()));
    const auto found = most_local_bias(learner, {&mean, 1});
    ASSERT_TRUE(found) << pose;
    RecordProperty("pose_" + std::to_string(pose) + "_sigmas",
                   std::to_string(std::abs(found->bias_px) / found->sigma_px));
    EXPECT_GT(found->p(), 3e-4) << pose << ": " << found->bias_px << " px at " << found->middle_px.transpose();
  }
}

}  // namespace real_desks_test
}  // namespace fathom
