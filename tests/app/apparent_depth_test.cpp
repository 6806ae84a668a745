// `fathom capture --mode geometric` over deep water measures its bottom where tables of refraction say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/image_file.h"
#include "core/json.h"
#include "core/units.h"
#include "tests/app/run_fathom.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

constexpr double kIndex = 1.3281, kDepthMm = 50.0, kBottomMm = 1.0, kRangeMm = 600.0, kFocalPx = 570.0;
const Eigen::Vector2d kPrincipalPx(4.5, 8.5);

/// One line of a table: the ratio of apparent to true depth where a line of sight ends that starts between camera and
/// projector, crosses 600 mm of air and then 50 mm of water.
struct Line {
  double incidence_deg, baseline_mm, ratio;
};

double height_mm(const Line& line) {
  return kBottomMm + kDepthMm + kRangeMm * std::cos(radians_from_deg(line.incidence_deg));
}

/// A basin, and a few rows about the optical axis.
Json basin_scene(const Line& line) {
  return {{"sensor",
           {{"height_mm", height_mm(line)},
            {"pitch_deg", 90.0 - line.incidence_deg},
            {"baseline_mm", line.baseline_mm},
            {"focal_px", kFocalPx},
            {"principal_px", {kPrincipalPx.x(), kPrincipalPx.y()}},
            {"depth_size_px", {64, 16}},
            {"ir_size_px", {128, 32}},
            {"quantization", "off"}}},
          {"cups", Json::array({{{"shape",
                                  {{"height_mm", kBottomMm + kDepthMm + 1.0},
                                   {"bottom_mm", kBottomMm},
                                   {"inner_radius_mm", 200.0},
                                   {"outer_radius_mm", 201.0}}},
                                 {"position_mm", {0.0, kRangeMm * std::sin(radians_from_deg(line.incidence_deg))}},
                                 {"liquid", {{"index", kIndex}}},
                                 {"fill_mm", kDepthMm}}})}};
}

/// What a capture says of its pixels, and the ratio of depths between them.
struct Captured {
  Image<float> depth, x, y;

  double ratio(const Line& line, int column, int row) const {
    const double pitch = radians_from_deg(90.0 - line.incidence_deg);
    const double down = (row + 0.5 - kPrincipalPx.y()) / kFocalPx;
    const double measured_mm =
        height_mm(line) - mm_from_metres(depth(column, row)) * (std::sin(pitch) + down * std::cos(pitch));
    return (kBottomMm + kDepthMm - measured_mm) / kDepthMm;
  }

  /// Where a row sees the plane x = 0, and the ratio there; linear between two pixels.
  std::pair<double, double> in_the_middle(const Line& line, int row) const {
    int column = 0;
    while (x(column + 1, row) < 0.0f) ++column;
    const double across = -x(column, row) / (x(column + 1, row) - x(column, row));
    return {std::lerp(y(column, row), y(column + 1, row), across),
            std::lerp(ratio(line, column, row), ratio(line, column + 1, row), across)};
  }

  /// At the bottom point (0, target_y) [m]; linear between two rows.
  double ratio_at(const Line& line, double target_y) const {
    int row = 0;
    while (in_the_middle(line, row + 1).first > target_y) ++row;
    const auto [far_y, far_ratio] = in_the_middle(line, row);
    const auto [near_y, near_ratio] = in_the_middle(line, row + 1);
    return std::lerp(far_ratio, near_ratio, (target_y - far_y) / (near_y - far_y));
  }
};

class ApparentDepth : public testing::TestWithParam<Line> {};

TEST_P(ApparentDepth, IsTheTabulatedOne) {
  const Line& line = GetParam();
  const TemporaryFolder folder;
  const std::filesystem::path scene = folder / "scene.json", out = folder / "out";
  write_json(scene, basin_scene(line));
  const ProgramRun run =
      run_fathom(fmt::format("capture {} -o {} --mode geometric --quiet", scene.string(), out.string()));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Captured captured{read_exr_channel(out / "depth.exr", "Z"), read_exr_channel(out / "truth.exr", "position.X"),
                          read_exr_channel(out / "truth.exr", "position.Y")};
  const double sine = std::sin(radians_from_deg(line.incidence_deg));
  const double target_mm = kRangeMm * sine + kDepthMm * std::tan(std::asin(sine / kIndex));
  // Half a unit of the last printed digit; disparity and depth are 32-bit floats, each rounded by up to 6e-8 of a depth
  // that is 13 times that of the water; between pixels the ratio bends by 4e-7.
  EXPECT_NEAR(captured.ratio_at(line, metres_from_mm(target_mm)), line.ratio, 5e-6 + 2.0 * 13.0 * 6e-8 + 4e-7);
}

std::string name_of(const testing::TestParamInfo<Line>& instance) {
  return fmt::format("{:g}deg", instance.param.incidence_deg);
}

// cos A / sqrt(n² − sin² A) for no baseline; 1 mm changes it by 1e-7.
INSTANTIATE_TEST_SUITE_P(ShortBaseline, ApparentDepth,
                         testing::Values(Line{0, 1, 0.75296}, Line{30, 1, 0.70386}, Line{45, 1, 0.62898},
                                         Line{60, 1, 0.49657}),
                         name_of);
// Two rays by Snell's law.
INSTANTIATE_TEST_SUITE_P(Baseline75mm, ApparentDepth,
                         testing::Values(Line{0, 75, 0.75239}, Line{45, 75, 0.62832}, Line{60, 75, 0.49592}), name_of);

}  // namespace
}  // namespace fathom
