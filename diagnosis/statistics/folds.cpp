#include "diagnosis/statistics/folds.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "core/rng.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

std::vector<int> deal_folds(const std::vector<Observation>& observations, std::uint64_t seed) {
  Groups units = group_by(observations, pour_key);
  const bool has_desk = std::any_of(units.of.begin(), units.of.end(), [](int unit) { return unit < 0; });
  if (units.count < 2 * kFolds || has_desk) {
    const bool by_pours = units.count >= 2 * kFolds;
    units = group_by(observations, [&](const Observation& o) {
      const std::string pour = pour_key(o);
      return by_pours && !pour.empty() ? pour : placement_key(o);
    });
  }
  const auto members = units.members();
  const auto order_of = [&](int unit) {
    const Factors& f = observations[members[unit][0]].factors;
    return std::tuple(f.liquid, f.fill_mm, f.distance_mm, f.lateral_mm, unit);
  };
  std::vector<int> order(units.count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return order_of(a) < order_of(b); });

  std::vector<int> fold_of_unit(units.count);
  std::array<int, kFolds> round{};
  for (int position = 0; position < units.count; ++position) {
    if (position % kFolds == 0) {
      std::iota(round.begin(), round.end(), 0);
      Rng rng(seed, position);
      for (int k = kFolds - 1; k > 0; --k) std::swap(round[k], round[rng.below(static_cast<std::uint32_t>(k + 1))]);
    }
    fold_of_unit[order[position]] = round[position % kFolds];
  }
  std::vector<int> folds;
  for (const int unit : units.of) folds.push_back(fold_of_unit[unit]);
  return folds;
}

std::vector<Eigen::Index> rows_in(const std::vector<int>& folds, const std::vector<int>& wanted, bool is_in) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < folds.size(); ++i)
    if ((std::find(wanted.begin(), wanted.end(), folds[i]) != wanted.end()) == is_in)
      rows.push_back(static_cast<Eigen::Index>(i));
  return rows;
}

}  // namespace fathom
