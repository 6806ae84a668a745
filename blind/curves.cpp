#include "blind/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/proportion.h"

namespace fathom::blind {
namespace {

std::string text(double value) { return fmt::format("{:.4f}", value); }

struct Count {
  int hits = 0, trials = 0;
  void add(bool hit) { ++trials, hits += hit; }
  double share() const { return trials > 0 ? static_cast<double>(hits) / trials : 0.0; }
  Interval interval() const { return clopper_pearson_95(hits, trials); }
};

std::vector<const Judged*> most_confident_first(std::span<const Judged> judged) {
  std::vector<const Judged*> order;
  for (const Judged& one : judged)
    if (one.truth.book_keeping.empty() && one.answer.verdict != "missing") order.push_back(&one);
  std::stable_sort(order.begin(), order.end(),
                   [](const Judged* a, const Judged* b) { return a->answer.confidence() > b->answer.confidence(); });
  return order;
}

}  // namespace

Table power_table(std::span<const Judged> judged) {
  constexpr std::array kBorders{0.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0, 1e9};
  Table table({"s_from", "s_to", "s_mean", "sets", "detected", "detected_low95", "detected_high95", "named",
               "named_low95", "named_high95", "matched_filter", "filter_bank"});
  for (std::size_t bin = 0; bin + 1 < kBorders.size(); ++bin) {
    Count detected, named;
    double bound = 0.0, bank = 0.0, sum = 0.0;
    for (const Judged& one : judged) {
      const double s = one.strongest();
      if (!one.is_single() || s < kBorders[bin] || s >= kBorders[bin + 1]) continue;
      detected.add(one.answer.detects_something());
      named.add(one.is_right());
      bound += power_of_filter(s);
      bank += power_of_filter(s, kBank);
      sum += s;
    }
    if (detected.trials == 0) continue;
    table.add({text(kBorders[bin]), text(std::min(kBorders[bin + 1], 100.0)), text(sum / detected.trials),
               fmt::format("{}", detected.trials), text(detected.share()), text(detected.interval().low),
               text(detected.interval().high), text(named.share()), text(named.interval().low),
               text(named.interval().high), text(bound / detected.trials), text(bank / detected.trials)});
  }
  return table;
}

Table confusion_table(std::span<const Judged> judged) {
  std::map<std::pair<std::string, std::string>, int> counts;
  for (const Judged& one : judged) ++counts[{one.hidden(), one.said()}];
  Table table({"hidden", "said", "sets"});
  for (const auto& [pair, count] : counts) table.add({pair.first, pair.second, fmt::format("{}", count)});
  return table;
}

Table reliability_table(std::span<const Judged> judged) {
  constexpr int kBins = 10;
  std::array<Count, kBins> counts;
  std::array<double, kBins> said{};
  for (const Judged* one : most_confident_first(judged)) {
    if (one->answer.ambiguity_set.empty()) continue;
    const double p = one->answer.confidence();
    const int bin = std::clamp(static_cast<int>(p * kBins), 0, kBins - 1);
    counts[bin].add(one->first_holds_truth());
    said[bin] += p;
  }
  Table table({"said", "true", "low95", "high95", "sets"});
  for (int bin = 0; bin < kBins; ++bin) {
    const Count& count = counts[bin];
    if (count.trials == 0) continue;
    table.add({text(said[bin] / count.trials), text(count.share()), text(count.interval().low),
               text(count.interval().high), fmt::format("{}", count.trials)});
  }
  return table;
}

Table risk_coverage_table(std::span<const Judged> judged) {
  Table table({"confidence", "coverage", "risk", "risk_low95", "risk_high95"});
  const auto order = most_confident_first(judged);
  Count wrong;
  for (std::size_t i = 0; i < order.size(); ++i) {
    wrong.add(!order[i]->is_right());
    // Answers of one confidence are given together.
    if (i + 1 < order.size() && order[i + 1]->answer.confidence() == order[i]->answer.confidence()) continue;
    table.add({text(order[i]->answer.confidence()),
               text(static_cast<double>(i + 1) / static_cast<double>(order.size())), text(wrong.share()),
               text(wrong.interval().low), text(wrong.interval().high)});
  }
  return table;
}

Table sets_table(std::span<const Judged> judged) {
  Table table({"set", "class", "design", "hidden", "s", "escape", "noise_scale", "heavy_tails", "verdict", "said",
               "probability", "right"});
  for (const Judged& one : judged)
    table.add({fmt::format("{:04}", one.truth.number), one.truth.kind, one.truth.design, one.hidden(),
               text(one.weakest()), text(one.truth.escape), text(one.truth.noise_scale),
               one.truth.heavy_tails ? "1" : "0", one.answer.verdict, one.said(), text(one.answer.confidence()),
               one.is_right() ? "1" : "0"});
  return table;
}

Table worst_table(std::span<const Judged> judged) {
  constexpr std::size_t kShown = 20;
  std::vector<const Judged*> wrong;
  for (const Judged& one : judged)
    if (!one.is_right()) wrong.push_back(&one);
  std::stable_sort(wrong.begin(), wrong.end(), [](const Judged* a, const Judged* b) {
    return std::pair(a->is_confidently_wrong(), a->strongest()) > std::pair(b->is_confidently_wrong(), b->strongest());
  });
  if (wrong.size() > kShown) wrong.resize(kShown);
  Table table({"set", "class", "design", "hidden", "s", "said", "probability", "confidently_wrong"});
  for (const Judged* one : wrong)
    table.add({fmt::format("{:04}", one->truth.number), one->truth.kind, one->truth.design, one->hidden(),
               text(one->strongest()), one->said(), text(one->answer.confidence()),
               one->is_confidently_wrong() ? "1" : "0"});
  return table;
}

}  // namespace fathom::blind
