// `fathom theory`: Eq. 7 and the exact triangulation of the raised bottom, side by side.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/options.h"
#include "app/results.h"
#include "core/json.h"
#include "core/rows.h"
#include "core/units.h"
#include "theory/raised_bottom.h"
#include "theory/triangulation.h"

namespace fathom {
namespace {

struct TheoryOptions {
  std::vector<double> fill_mm{10.0, 20.0, 30.0};
  std::vector<double> distance_mm{200.0, 300.0, 400.0, 500.0, 600.0};
  std::vector<double> lateral_mm{0.0};
  double height_mm = 650.0;
  double index = 1.333;
  std::optional<double> pitch_deg;
  double baseline_mm = 75.0;
  bool max_skew = false;
};

// The paper's sensor, Fig. 12.
constexpr double kPaperFieldOfViewDeg = 58.5;
constexpr double kPaperMinimumRangeMm = 500.0;

constexpr std::array kColumns{"fill_mm", "distance_mm", "lateral_mm", "incidence_projector_deg", "incidence_camera_deg",
                              "eq7_mm",  "exact_mm",    "epipolar_px"};
using TheoryRow = std::array<double, kColumns.size()>;

constexpr Range kUpToOneKilometre{0.0, 1e6, true};

/// What a check of one option cannot know: the sensor is above the liquid.
void check_fills(const TheoryOptions& options) {
  for (const double fill_mm : options.fill_mm)
    if (fill_mm >= options.height_mm)
      throw UsageError(
          fmt::format("--fill-mm: must be below the sensor's height {}, got {}", options.height_mm, fill_mm));
}

TheoryRow theory_row(const TheoryOptions& options, double fill_mm, double distance_mm, double lateral_mm) {
  theory::TriangulationSetup setup{.sensor_height = metres_from_mm(options.height_mm),
                                   .baseline = metres_from_mm(options.baseline_mm),
                                   .fill = metres_from_mm(fill_mm),
                                   .index = options.index,
                                   .lateral = metres_from_mm(lateral_mm),
                                   .distance = metres_from_mm(distance_mm)};
  if (options.pitch_deg) setup.pitch = radians_from_deg(*options.pitch_deg);
  const auto [eq7, exact] = theory::raised_bottom(setup);
  return {fill_mm,
          distance_mm,
          lateral_mm,
          deg_from_radians(exact.incidence_projector),
          deg_from_radians(exact.incidence_camera),
          mm_from_metres(eq7),
          mm_from_metres(exact.height),
          exact.epipolar_mismatch_px};
}

std::string csv(const std::vector<TheoryRow>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(kColumns, ","));
  for (TheoryRow row : rows) {
    for (double& value : row) value = std::round(value * 1e6) / 1e6 + 0.0;  // + 0.0: no "-0.000000"
    text += fmt::format("{},{},{},{:.6f}\n", row[0], row[1], row[2], fmt::join(row.begin() + 3, row.end(), ","));
  }
  return text;
}

std::string json(const std::vector<TheoryRow>& rows) {
  Json list = Json::array();
  for (const TheoryRow& row : rows) {
    Json object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) object[kColumns[i]] = row[i];
    list.push_back(std::move(object));
  }
  return json_text(list);
}

std::string theory_text(const TheoryOptions& options, bool as_json) {
  check_fills(options);
  if (options.max_skew) {
    const double skew =
        theory::skew_at_field_edge(metres_from_mm(options.baseline_mm), radians_from_deg(kPaperFieldOfViewDeg),
                                   metres_from_mm(kPaperMinimumRangeMm));
    return format_rows({{"max_skew", deg_from_radians(skew), "deg"}}, as_json);
  }
  std::vector<TheoryRow> rows;
  for (const double fill : options.fill_mm)
    for (const double distance : options.distance_mm)
      for (const double lateral : options.lateral_mm) rows.push_back(theory_row(options, fill, distance, lateral));
  return as_json ? json(rows) : csv(rows);
}

}  // namespace

std::function<void()> define_theory(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<TheoryOptions>();
  add_number_list(app, "--fill-mm", options->fill_mm, "Depths of the liquid", kNonNegative);
  add_number_list(app, "--distance-mm", options->distance_mm,
                  "Horizontal distances of the bottom point from the sensor", {0.0, 1e6});
  add_number_list(app, "--lateral-mm", options->lateral_mm, "Positions of the bottom point to the sensor's right",
                  {-1e6, 1e6});
  app.add_option("--height-mm", options->height_mm, "Height of the sensor above the bottom")
      ->check(number_within(kUpToOneKilometre))
      ->capture_default_str();
  app.add_option("--index", options->index, "Index of the liquid relative to air")
      ->check(number_within({1.0, 10.0}))
      ->capture_default_str();
  app.add_option("--pitch-deg", options->pitch_deg,
                 "0: the sensor looks horizontally, 90: straight down; without it, it aims at (0, distance, 0)")
      ->check(number_within({0.0, 90.0}));
  app.add_option("--baseline-mm", options->baseline_mm, "Distance of camera and projector")
      ->check(number_within(kUpToOneKilometre))
      ->capture_default_str();
  app.add_flag("--max-skew", options->max_skew,
               "Only the largest difference of the two incidence angles at the paper's 58.5 deg and 500 mm (Fig. 12)");
  return [options, &common] {
    const std::string text = theory_text(*options, common.json);
    print_results(common, options->max_skew ? "max_skew" : "theory", options->max_skew ? ".txt" : ".csv", text);
  };
}

}  // namespace fathom
