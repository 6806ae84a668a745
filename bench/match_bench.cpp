// Our matcher beside OpenCV's on the same dots, all on one thread.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>

#include "bench/benchmark_groups.h"
#include "bench/measure.h"
#include "bench/stereo_pair.h"
#include "core/median.h"
#include "sim/sensor/depth.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();

struct MatchError {
  double valid = 0;      ///< share of the lit pixels that have a disparity
  double median_px = 0;  ///< of |e| over the valid pixels
  double rms_px = 0;     ///< of the inliers, |e| < 1 px
  double outliers = 0;   ///< share of the valid pixels with |e| ≥ 1 px
};

/// Compares disparities relative to the reference plane [px], NaN = invalid, with the truth. Columns whose search range
/// leaves OpenCV's images, and rows whose window does, are left out for every matcher.
MatchError match_error(const StereoPair& pair, const Image<float>& disparity_px) {
  const MatcherModel& matcher = pair.sensor.matcher;
  const int half_columns = matcher.window_columns / 2, half_rows = matcher.window_rows / 2;
  const int first = std::max(matcher.disparity_max_px, 0) + half_columns;
  const int last = disparity_px.width() - 1 + std::min(matcher.disparity_min_px, 0) - half_columns;
  double lit = 0, inliers = 0, squares = 0;
  std::vector<double> errors;
  for (int y = half_rows; y < disparity_px.height() - half_rows; ++y)
    for (int x = first; x <= last; ++x) {
      if (std::isnan(pair.true_disparity_px(x, y))) continue;
      ++lit;
      if (std::isnan(disparity_px(x, y))) continue;
      const double error = std::fabs(disparity_px(x, y) - pair.true_disparity_px(x, y));
      errors.push_back(error);
      if (error >= 1.0) continue;
      ++inliers;
      squares += error * error;
    }
  if (inliers == 0) return {};
  const double valid = static_cast<double>(errors.size());
  return {valid / lit, median(std::move(errors)), std::sqrt(squares / inliers), 1.0 - inliers / valid};
}

Image<float> relative_to_reference(const SensorModel& sensor, const Image<float>& disparity_px) {
  const auto at_reference = static_cast<float>(disparity_of_depth(sensor, sensor.reference));
  Image<float> relative(disparity_px.width(), disparity_px.height(), kInvalid);
  for (std::size_t i = 0; i < relative.size(); ++i)
    if (disparity_px.pixels()[i] > 0.0f) relative.pixels()[i] = disparity_px.pixels()[i] - at_reference;
  return relative;
}

/// OpenCV's disparities count sixteenths of a pixel; those below the range are invalid.
Image<float> from_sixteenths(const SensorModel& sensor, const cv::Mat& sixteenths) {
  Image<float> disparity(sixteenths.cols, sixteenths.rows, kInvalid);
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x) {
      const auto value = sixteenths.at<std::int16_t>(y, x);
      if (value >= 16 * sensor.matcher.disparity_min_px) disparity(x, y) = static_cast<float>(value) / 16.0f;
    }
  return disparity;
}

int disparity_count(const MatcherModel& matcher) { return matcher.disparity_max_px - matcher.disparity_min_px + 1; }

cv::Ptr<cv::StereoMatcher> block_matcher(const MatcherModel& matcher) {
  const auto result = cv::StereoBM::create(disparity_count(matcher), matcher.window_columns);
  result->setMinDisparity(matcher.disparity_min_px);
  return result;
}

/// Penalties as OpenCV's documentation proposes them: 8 and 32 times the block's area.
cv::Ptr<cv::StereoMatcher> semi_global_matcher(const MatcherModel& matcher) {
  const int area = matcher.window_columns * matcher.window_columns;
  const auto result = cv::StereoSGBM::create(matcher.disparity_min_px, disparity_count(matcher), matcher.window_columns,
                                             8 * area, 32 * area);
  result->setMode(cv::StereoSGBM::MODE_SGBM);
  return result;
}

void report(benchmark::State& state, const MatchError& error) {
  state.counters["valid"] = error.valid;
  state.counters["median_px"] = error.median_px;
  state.counters["rms_px"] = error.rms_px;
  state.counters["outliers"] = error.outliers;
}

void measure_match(benchmark::State& state, const StereoPair& pair) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  Image<float> found;
  for (auto _ : state) found = match(pair.sensor, pair.ir, pair.reference);
  report(state, match_error(pair, relative_to_reference(pair.sensor, found)));
}

void measure_opencv(benchmark::State& state, const StereoPair& pair, const cv::Ptr<cv::StereoMatcher>& matcher) {
  cv::setNumThreads(1);
  cv::Mat sixteenths;
  for (auto _ : state) matcher->compute(pair.live, pair.halved_reference, sixteenths);
  report(state, match_error(pair, from_sixteenths(pair.sensor, sixteenths)));
}

void register_pair(const std::string& name, const Setup& setup, const NoiseModel& noise) {
  const auto pair = std::make_shared<const StereoPair>(make_stereo_pair(setup, noise));
  const MatcherModel& matcher = pair->sensor.matcher;
  const auto add = [&](const char* side, auto work) { register_timed(fmt::format("match/{}/{}", name, side), work); };
  add("fathom", [pair](benchmark::State& state) { measure_match(state, *pair); });
  add("bm", [pair, bm = block_matcher(matcher)](benchmark::State& state) { measure_opencv(state, *pair, bm); });
  add("sgbm",
      [pair, sgbm = semi_global_matcher(matcher)](benchmark::State& state) { measure_opencv(state, *pair, sgbm); });
}

}  // namespace

void register_match() {
  const Setup water = paper_water(), plane = slanted_plane();
  const NoiseModel clean, noisy = water.rig.sensor.noise;
  register_pair("water_clean", water, clean);
  register_pair("water_noisy", water, noisy);
  register_pair("plane_clean", plane, clean);
  register_pair("plane_noisy", plane, noisy);
}

}  // namespace fathom
