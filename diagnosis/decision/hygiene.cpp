#include "diagnosis/decision/hygiene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "core/median.h"
#include "diagnosis/statistics/groups.h"
#include "diagnosis/statistics/problem.h"

namespace fathom {

namespace {

constexpr double kFarBetter = 3.0;    // ratio of the heights' residuals: most of them is gone
constexpr double kOtherCup_mm = 4.0;  // shift of one pour against the others: no error of filling
constexpr std::size_t kFewestTwins = 4;

void check_unit(const Evidence& evidence, std::vector<std::string>& warnings) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i)
    if (is_height(evidence.observations[i]) && std::abs(evidence.predicted[static_cast<Eigen::Index>(i)]) > 1.0)
      ratios.push_back(std::abs(evidence.observations[i].value / evidence.predicted[static_cast<Eigen::Index>(i)]));
  if (ratios.size() < kFewestTwins) return;
  const double ratio = median(ratios);
  for (const double unit : {1e-3, 1e-2, 1e-1, 1.0 / 25.4, 25.4, 10.0, 100.0, 1000.0})
    if (std::abs(std::log(ratio / unit)) < 0.15)
      warnings.push_back(fmt::format("heights are {:.3g} times the prediction: another unit?", ratio));
}

void check_duplicates(const Evidence& evidence, std::vector<std::string>& warnings) {
  const Groups placements = group_by(evidence.observations, placement_key);
  const auto members = placements.members();
  std::map<std::vector<std::pair<double, double>>, int> known;
  for (int placement = 0; placement < placements.count; ++placement) {
    if (members[placement].size() < kFewestTwins) continue;
    std::vector<std::pair<double, double>> numbers;
    bool has_scatter = false;
    for (const auto row : members[placement]) {
      numbers.emplace_back(evidence.observations[row].value, evidence.observations[row].repeat_sd);
      has_scatter |= evidence.observations[row].repeat_sd > 0.0;
    }
    const auto [twin, is_new] = known.emplace(std::move(numbers), placement);
    if (!is_new && has_scatter)
      warnings.push_back(fmt::format("'{}' and '{}' have identical numbers: one measured, copied?",
                                     placement_key(evidence.observations[members[twin->second][0]]),
                                     placement_key(evidence.observations[members[placement][0]])));
  }
}

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

void check_mirrored(const Evidence& evidence, std::vector<std::string>& warnings) {
  const auto mirrored_cell = [](Observation o) {
    o.factors.lateral_mm = 0.0 - o.factors.lateral_mm;
    return cell_key(o);
  };
  std::map<std::string, double> predictions;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i)
    predictions.emplace(cell_key(evidence.observations[i]), evidence.predicted[static_cast<Eigen::Index>(i)]);
  std::vector<double> as_is, mirrored;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    const Observation& o = evidence.observations[i];
    const auto other = predictions.find(mirrored_cell(o));
    if (!is_height(o) || o.factors.lateral_mm == 0.0 || other == predictions.end()) continue;
    as_is.push_back(o.value - evidence.predicted[static_cast<Eigen::Index>(i)]);
    mirrored.push_back(o.value - other->second);
  }
  if (as_is.size() >= kFewestTwins && rms(as_is) > kFarBetter * rms(mirrored))
    warnings.emplace_back("left and right fit far better exchanged: a flipped axis?");
}

/// Two pours whose predictions, condition by condition, fit each other's measurements.
void check_swapped(const Evidence& evidence, std::vector<std::string>& warnings) {
  const Groups pours = group_by(evidence.observations, pour_key);
  const auto members = pours.members();
  const auto place = [](const Observation& o) {
    return fmt::format("{}/{}/{}/{}", o.observable, o.factors.region, o.factors.distance_mm, o.factors.lateral_mm);
  };
  std::vector<std::map<std::string, Eigen::Index>> at(pours.count);
  for (int pour = 0; pour < pours.count; ++pour)
    for (const auto row : members[pour])
      if (is_height(evidence.observations[row])) at[pour].emplace(place(evidence.observations[row]), row);
  for (int a = 0; a < pours.count; ++a)
    for (int b = a + 1; b < pours.count; ++b) {
      const Factors& one = evidence.observations[members[a][0]].factors;
      const Factors& other = evidence.observations[members[b][0]].factors;
      if (one.liquid == other.liquid && one.fill_mm == other.fill_mm) continue;
      std::vector<double> as_is, swapped;
      const auto add = [&](Eigen::Index row, Eigen::Index partner) {
        as_is.push_back(evidence.observations[row].value - evidence.predicted[row]);
        swapped.push_back(evidence.observations[row].value - evidence.predicted[partner]);
      };
      for (const auto& [where, row] : at[a])
        if (const auto partner = at[b].find(where); partner != at[b].end()) {
          add(row, partner->second);
          add(partner->second, row);
        }
      if (as_is.size() >= kFewestTwins && rms(as_is) > kFarBetter * rms(swapped))
        warnings.push_back(
            fmt::format("{} {} mm (pour {}) and {} {} mm (pour {}) fit far better exchanged: labels swapped?",
                        one.liquid, one.fill_mm, one.pour, other.liquid, other.fill_mm, other.pour));
    }
}

void check_other_cup(const Evidence& evidence, std::vector<std::string>& warnings) {
  const Eigen::VectorXd off = measured_minus_predicted(evidence);
  const Groups pours = group_by(evidence.observations, [](const Observation& o) {
    return o.observable == "height_mm" ? pour_key(o) : std::string();
  });
  if (pours.count < 3) return;
  std::vector<double> shifts;
  const auto members = pours.members();
  for (const auto& rows : members) {
    const Eigen::VectorXd part_off = off(rows);
    shifts.push_back(median(std::vector<double>(part_off.data(), part_off.data() + part_off.size())));
  }
  const double middle = median(shifts);
  for (int pour = 0; pour < pours.count; ++pour) {
    const Factors& factors = evidence.observations[members[pour][0]].factors;
    if (std::abs(shifts[pour] - middle) > kOtherCup_mm)
      warnings.push_back(fmt::format(
          "pour {} of session {} ({} {} mm) reads {:+.1f} mm off what the model has, where the middle of all "
          "pours is {:+.1f} mm off: another cup or filling?",
          factors.pour, factors.session, factors.liquid, factors.fill_mm, shifts[pour], middle));
  }
}

/// A height of a table that stands alone: all others of its liquid and fill lie together, far from it.
void check_single_readings(const Evidence& evidence, std::vector<std::string>& warnings) {
  constexpr std::size_t kFewest = 4;
  constexpr double kAlone = 10.0;  // times as far from the others as these lie apart: one normal sample of four in 500
  const Eigen::VectorXd off = measured_minus_predicted(evidence);
  const Groups fillings = group_by(evidence.observations, [](const Observation& o) {
    const bool is_of_table = is_height(o) && o.factors.region == "interior";
    return is_of_table ? fmt::format("{} {:g}", o.factors.liquid, o.factors.fill_mm) : std::string();
  });
  for (std::vector<Eigen::Index> rows : fillings.members()) {
    if (rows.size() < kFewest) continue;
    std::sort(rows.begin(), rows.end(), [&](auto a, auto b) { return off[a] < off[b]; });
    const auto check = [&](Eigen::Index one, Eigen::Index lowest, Eigen::Index highest) {
      const double away = std::max(off[lowest] - off[one], off[one] - off[highest]);
      if (away < kOtherCup_mm || away < kAlone * (off[highest] - off[lowest])) return;
      const Factors& f = evidence.observations[one].factors;
      warnings.push_back(fmt::format(
          "one reading of {} {} mm (session {}, pour {}, {} mm away) is {:+.1f} mm off what the model has, where the "
          "other {} are {:+.1f} to {:+.1f} mm off: a typing error?",
          f.liquid, f.fill_mm, f.session, f.pour, f.distance_mm, off[one], rows.size() - 1, off[lowest], off[highest]));
    };
    check(rows.front(), rows[1], rows.back());
    check(rows.back(), rows.front(), rows[rows.size() - 2]);
  }
}

/// Heights that are all the same number, where the model has them differ.
void check_all_alike(const Evidence& evidence, std::vector<std::string>& warnings) {
  constexpr double kDiffer_mm = 3.0;
  std::vector<double> heights_mm, predicted_mm;
  for (std::size_t i = 0; i < evidence.observations.size(); ++i)
    if (is_height(evidence.observations[i])) {
      heights_mm.push_back(evidence.observations[i].value);
      predicted_mm.push_back(evidence.predicted[static_cast<Eigen::Index>(i)]);
    }
  if (heights_mm.size() < kFewestTwins) return;
  const auto [lowest, highest] = std::ranges::minmax(predicted_mm);
  if (highest - lowest > kDiffer_mm && std::ranges::all_of(heights_mm, [&](double h) { return h == heights_mm[0]; }))
    warnings.push_back(fmt::format("all {} heights are {:g} mm: is this column another quantity?", heights_mm.size(),
                                   heights_mm.front()));
}

/// Such clouds have the same axes, but begin where the colour camera is; their points keep their depths.
void check_colour_view(const Evidence& evidence, std::vector<std::string>& warnings) {
  constexpr double kColourCamera_mm = 25.0, kByHand_mm = 3.0;  // of Carmine, Xtion and Kinect; a place's error
  const Eigen::VectorXd off = measured_minus_predicted(evidence);
  const auto median_of = [&](std::string_view observable) -> std::optional<double> {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < off.size(); ++i)
      if (evidence.observations[i].observable == observable) values.push_back(off[i]);
    return values.size() < kFewestTwins ? std::nullopt : std::optional(median(values));
  };
  const std::optional<double> x = median_of("cup_x_mm"), y = median_of("cup_y_mm");
  if (x && y && std::hypot(*x + kColourCamera_mm, *y) < kByHand_mm)
    warnings.push_back(
        fmt::format("cups stand {:.0f} mm to the left of their places, as in clouds that are registered to the colour "
                    "camera, 25 mm beside the infrared one: depth_registered for depth?",
                    -*x));
}

}  // namespace

std::vector<std::string> hygiene_warnings(const Evidence& evidence) {
  std::vector<std::string> warnings;
  check_unit(evidence, warnings);
  check_duplicates(evidence, warnings);
  check_mirrored(evidence, warnings);
  check_swapped(evidence, warnings);
  check_other_cup(evidence, warnings);
  check_single_readings(evidence, warnings);
  check_all_alike(evidence, warnings);
  check_colour_view(evidence, warnings);
  return warnings;
}

}  // namespace fathom
