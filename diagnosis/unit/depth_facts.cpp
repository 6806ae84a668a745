#include "diagnosis/unit/depth_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "core/units.h"
#include "diagnosis/unit/bias_view.h"

namespace fathom {
namespace {

constexpr int kPhaseSteps = 512;  ///< of a code, in which its phase is looked for: …
constexpr int kFarthest = 16;     ///< … so many on either side of what depths have on average
constexpr int kRoundPhases = 16;  ///< of a code; the nearest one is taken where it does as well
constexpr double kOnLaw = 0.98;
constexpr double kTooOften = 0.9;   ///< steps hardly wider than what depths are cut to say nothing
constexpr double kWhole_mm = 0.01;  ///< what floats and drivers round

/// Depths [mm] of some thousand points, evenly.
std::vector<double> some_depths(std::span<const Points> clouds) {
  constexpr std::size_t kEnough = 20'000;
  std::size_t all = 0;
  for (const Points& points : clouds) all += points.size();
  const std::size_t every = std::max<std::size_t>(1, all / kEnough);
  std::vector<double> depths;
  std::size_t number = 0;
  for (const Points& points : clouds)
    for (const Eigen::Vector3f& point : points)
      if (number++ % every == 0 && point.allFinite() && point.z() > 0.0f)
        depths.push_back(mm_from_metres(static_cast<double>(point.z())));
  return depths;
}

double share_of_multiples(const std::vector<double>& depths, double unit_mm) {
  const auto whole = std::ranges::count_if(
      depths, [&](double depth) { return std::abs(depth - unit_mm * std::round(depth / unit_mm)) < kWhole_mm; });
  return static_cast<double>(whole) / static_cast<double>(depths.size());
}

struct Law {
  double steps_mm;  ///< 8 f b
  double phase, cut_mm;

  /// Of a depth, not whole; half of what is cut off added.
  double exact_code(double depth) const {
    return steps_mm * (1.0 / mm_from_metres(kReferenceDistance_m) - 1.0 / (depth + 0.5 * cut_mm)) - phase;
  }
  double depth(int code) const {
    const double exact = 1.0 / (1.0 / mm_from_metres(kReferenceDistance_m) - (code + phase) / steps_mm);
    return cut_mm > 0.0 ? cut_mm * std::floor(exact / cut_mm) : exact;
  }
  /// The code whose depth this is; nothing where none has it.
  std::optional<int> code(double depth) const {
    constexpr double kMostCodes = 1e6;  // of a depth that is all but 0
    const int near = static_cast<int>(std::lround(std::clamp(exact_code(depth), -kMostCodes, kMostCodes)));
    for (const int code : {near, near - 1, near + 1})
      if (std::abs(this->depth(code) - depth) < 1.5 * kWhole_mm) return code;
    return std::nullopt;
  }
};

/// The phase that whole codes have on average, from 0 to 1: what cutting does to them is even.
double mean_phase(const Law& law, const std::vector<double>& depths) {
  std::complex<double> sum;
  for (const double depth : depths) sum += std::polar(1.0, 2.0 * std::numbers::pi * law.exact_code(depth));
  const double turns = std::arg(sum) / (2.0 * std::numbers::pi);
  return turns - std::floor(turns);
}

}  // namespace

DepthFacts depth_facts(std::span<const Points> clouds, std::span<const double> focal_px, double baseline_m) {
  DepthFacts facts;
  const std::vector<double> depths = some_depths(clouds);
  if (depths.empty()) return facts;
  for (const double unit_mm : {1.0, 0.1})
    if (facts.cut_mm == 0.0 && share_of_multiples(depths, unit_mm) > kOnLaw) facts.cut_mm = unit_mm;
  double by_chance = 1.0;
  std::vector<int> codes;
  for (const double focal : focal_px) {
    Law law{8.0 * focal * mm_from_metres(baseline_m), 0.0, facts.cut_mm};
    const double mean = mean_phase(law, depths);
    std::vector<double> phases{std::round(mean * kRoundPhases) / kRoundPhases};  // of those that do as well the first
    for (int i = -kFarthest; i <= kFarthest; ++i) phases.push_back((std::round(kPhaseSteps * mean) + i) / kPhaseSteps);
    for (const double phase : phases) {
      law.phase = phase - std::floor(phase);
      std::vector<int> found;
      double steps_mm = 0.0;
      for (const double depth : depths) {
        if (const auto code = law.code(depth)) found.push_back(*code);
        steps_mm += depth * depth / law.steps_mm;
      }
      const double share = static_cast<double>(found.size()) / static_cast<double>(depths.size());
      if (share <= facts.on_law) continue;
      facts.on_law = share, facts.phase = law.phase, facts.focal_px = focal;
      const double mean_step = steps_mm / static_cast<double>(depths.size());
      by_chance = std::min(1.0, std::max(facts.cut_mm, 4.0 * kWhole_mm) / mean_step);
      codes = std::move(found);
    }
  }
  if (facts.on_law < kOnLaw || by_chance > kTooOften) {
    facts.phase = 0.0;
    return facts;
  }
  for (const int together : {2, 4}) {
    std::vector<std::size_t> of_rest(together);
    for (const int code : codes) ++of_rest[((code % together) + together) % together];
    if (static_cast<double>(*std::ranges::max_element(of_rest)) > kOnLaw * static_cast<double>(codes.size()))
      facts.codes_per_step = together;
  }
  facts.step_px = 0.125 * facts.codes_per_step;
  return facts;
}

}  // namespace fathom
