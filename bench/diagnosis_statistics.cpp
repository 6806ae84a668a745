// usage: diagnosis_statistics [SETS] [FIRST_SEED]
// How often the diagnosis is right on synthetic campaigns of which the truth is known: SETS (100) of each class, with
// Clopper and Pearson's 95 % intervals, beside the goals and beside simpler methods on the same sets. Thresholds were
// frozen on seeds below 1000000; figures are to be reported from others (the default is 3000000).
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

#include "bench/baselines/diagnosis_baselines.h"
#include "core/median.h"
#include "core/proportion.h"
#include "core/rng.h"
#include "diagnosis/decision/decide.h"
#include "tests/diagnosis/statistics/synthetic_campaign.h"

namespace {

using namespace fathom;

constexpr int kMoreNulls = 3;  // times as many sets as of the other classes: their goals are small rates

struct Share {
  int hits = 0, trials = 0;
  void count(bool hit) {
    hits += hit;
    ++trials;
  }
  std::string text() const {
    if (trials == 0) return "–";
    const auto [low, high] = clopper_pearson_95(hits, trials);
    return fmt::format("{}/{} = {:.1f} % [{:.1f}, {:.1f}]", hits, trials, 100.0 * hits / trials, 100.0 * low,
                       100.0 * high);
  }
};

void row(const std::string& what, const std::string& goal, const std::string& value) {
  fmt::print("| {} | {} | {} |\n", what, goal, value);
  std::fflush(stdout);
}

/// One campaign with its truth and what was said about it.
struct Case {
  std::vector<EffectValue> truth;
  Evidence evidence;
  Diagnosis diagnosis;

  std::set<std::string> effects() const {
    std::set<std::string> names;
    for (const EffectValue& value : truth) names.insert(value.effect);
    return names;
  }
  bool names_something() const {
    const Verdict v = diagnosis.verdict;
    return v == Verdict::named || v == Verdict::named_and_unknown || v == Verdict::ambiguous;
  }
  bool says_unknown() const {
    return diagnosis.verdict == Verdict::unknown || diagnosis.verdict == Verdict::named_and_unknown;
  }
  bool contains(const Explanation& explanation) const {
    const auto is_truth = [&](const std::vector<std::string>& names) {
      return std::set<std::string>(names.begin(), names.end()) == effects();
    };
    return is_truth(explanation.effects) ||
           std::any_of(explanation.alternatives.begin(), explanation.alternatives.end(), is_truth);
  }
  bool is_top() const { return !diagnosis.ambiguity_set.empty() && contains(diagnosis.ambiguity_set.front()); }
  bool is_inside() const {
    return std::any_of(diagnosis.ambiguity_set.begin(), diagnosis.ambiguity_set.end(),
                       [&](const Explanation& e) { return contains(e); });
  }
  bool is_confidently_wrong() const {
    const Verdict v = diagnosis.verdict;
    if (v != Verdict::named && v != Verdict::named_and_unknown) return false;
    std::set<std::string> named;
    for (const NamedEffect& effect : diagnosis.effects) named.insert(effect.name);
    return named != effects();
  }
};

bool is_right(const Evidence& evidence, const std::vector<int>& chosen, const Case& c) {
  std::set<std::string> names;
  for (const int k : chosen) names.insert(evidence.candidates[k].effect);
  return names == c.effects();
}

struct Baselines {
  Share greedy, lasso, correlation;
  void count(const Case& c) {
    greedy.count(is_right(c.evidence, greedy_bic(c.evidence), c));
    lasso.count(is_right(c.evidence, lasso_bic(c.evidence), c));
    correlation.count(is_right(c.evidence, largest_correlation(c.evidence), c));
  }
  void print(const std::string& what) const {
    row(what + ": greedy BIC, independent noise", "", greedy.text());
    row(what + ": LASSO, λ by BIC", "", lasso.text());
    row(what + ": largest correlation", "", correlation.text());
  }
};

class Bench {
 public:
  Bench(const CampaignDesign& design, int sets, std::uint64_t first_seed)
      : world_(design), sets_(sets), next_(first_seed) {}

  Case run(const std::vector<EffectValue>& truth, const Errors& errors, const Eigen::VectorXd& unregistered = {}) {
    Case c{truth, world_.measure(truth, errors, next_++, unregistered), {}};
    const auto start = std::chrono::steady_clock::now();
    c.diagnosis = decide(c.evidence, world_.predict());
    seconds_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return c;
  }

  void nulls(const std::string& what, const std::string& goal, const std::function<Errors(Rng&)>& errors) {
    Share named, unknown;
    Baselines baselines;
    for (int k = 0; k < kMoreNulls * sets_; ++k) {
      Rng rng(next_, 1);
      const Case c = run({}, errors(rng));
      named.count(c.names_something());
      unknown.count(c.diagnosis.verdict == Verdict::unknown);
      baselines.count(c);
    }
    row(what + ": names something", goal, named.text());
    row(what + ": says unknown", goal, unknown.text());
    baselines.print(what + ", rightly nothing");
  }

  void several(const std::string& what, int effects, double low, double high, const std::string& goal_top,
               bool is_detailed) {
    Share top, named, inside, wrong, covered;
    Baselines baselines;
    std::vector<double> closed, above_floor, sizes;
    std::string missed;
    for (int k = 0; k < sets_; ++k) {
      Rng rng(next_, 2);
      const Case c = run(draw(rng, effects, low, high), {});
      top.count(c.is_top());
      if (!c.is_top()) {
        for (const EffectValue& value : c.truth) missed += value.effect + " ";
        missed += fmt::format("({}) ", name_of(c.diagnosis.verdict));
      }
      named.count(c.diagnosis.verdict == Verdict::named && !c.is_confidently_wrong());
      inside.count(c.is_inside());
      wrong.count(c.is_confidently_wrong());
      sizes.push_back(static_cast<double>(c.diagnosis.ambiguity_set.size()));
      baselines.count(c);
      if (c.diagnosis.effects.empty() || c.is_confidently_wrong()) continue;
      for (const NamedEffect& effect : c.diagnosis.effects)
        for (const EffectValue& value : c.truth)
          if (value.effect == effect.name)
            covered.count(effect.parameters[0].low95 <= value.values[0] &&
                          value.values[0] <= effect.parameters[0].high95);
      const GapSize& gap = c.diagnosis.gap.held_out;
      const double floor2 = gap.noise_floor_mm * gap.noise_floor_mm;
      const double open2 = gap.before_rms_mm * gap.before_rms_mm - floor2;
      if (open2 > 0.5 * floor2) closed.push_back(1.0 - (gap.after_rms_mm * gap.after_rms_mm - floor2) / open2);
      above_floor.push_back(gap.after_rms_mm / gap.noise_floor_mm);
    }
    row(what + ": top-1", goal_top, top.text());
    if (is_detailed) row(what + ": not first, and what was said", "", missed);
    row(what + ": named, rightly", "", named.text());
    row(what + ": truth in the ambiguity set", "≥ 99 %", inside.text());
    row(what + ": confidently wrong", "≤ 3 %", wrong.text());
    double mean = 0.0;
    for (const double size : sizes) mean += size / static_cast<double>(sizes.size());
    row(what + ": mean size of the set", is_detailed ? "≤ 1.2" : "", fmt::format("{:.2f}", mean));
    if (is_detailed) {
      row(what + ": 95 % intervals that hold the truth", "93–97 %", covered.text());
      if (!closed.empty())
        row(what + ": gap closed on held-out groups, median", "≥ 95 %",
            fmt::format("{:.1f} %", 100.0 * median(closed)));
      if (!above_floor.empty())
        row(what + ": held-out RMS over noise floor, median", "≤ 1.05", fmt::format("{:.3f}", median(above_floor)));
    }
    baselines.print(what);
  }

  void aliased() {
    Share ambiguous;
    for (int k = 0; k < sets_; ++k) {
      Rng rng(next_, 3);
      const Case c = run(
          {world_.at_strength("cup_bottom_height", 8.0 + 12.0 * rng.uniform(), rng.uniform() < 0.5 ? 1.0 : -1.0)}, {});
      const bool has_both = c.is_inside() && !c.diagnosis.ambiguity_set.front().alternatives.empty();
      ambiguous.count(c.diagnosis.verdict == Verdict::ambiguous && has_both);
    }
    row("exact aliases, s 8–20: reported ambiguous", "100 %", ambiguous.text());
  }

  void unknowns(double escape, const std::string& goal) {
    Share flagged, wrong;
    for (int k = 0; k < sets_; ++k) {
      const Case c = run({}, {}, world_.escaping(escape, next_));
      flagged.count(c.says_unknown());
      wrong.count(c.diagnosis.verdict == Verdict::named || c.diagnosis.verdict == Verdict::named_and_unknown);
    }
    row(fmt::format("unknown, escape {}: flagged", escape), goal, flagged.text());
    row(fmt::format("unknown, escape {}: names an effect", escape), escape >= 8.0 ? "≤ 1 %" : "≤ 3 %", wrong.text());
  }

  double median_seconds() const { return median(seconds_); }
  std::size_t observations() const { return world_.nominal().observations.size(); }

 private:
  /// Different effects, none of them aliased, of random strengths and signs.
  std::vector<EffectValue> draw(Rng& rng, int effects, double low, double high) const {
    std::vector<EffectValue> truth;
    std::set<std::string> used{"cup_bottom_height", "cup_on_coaster"};
    while (static_cast<int>(truth.size()) < effects) {
      const auto& candidates = world_.nominal().candidates;
      const std::string& name = candidates[rng.below(static_cast<std::uint32_t>(candidates.size()))].effect;
      if (!used.insert(name).second) continue;
      truth.push_back(world_.at_strength(name, low + (high - low) * rng.uniform(), rng.uniform() < 0.5 ? 1.0 : -1.0));
    }
    return truth;
  }

  World world_;
  int sets_;
  std::uint64_t next_;
  std::vector<double> seconds_;
};

}  // namespace

int main(int argc, char** argv) {
  const int sets = argc > 1 ? std::atoi(argv[1]) : 100;
  const std::uint64_t first_seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 3000000;
  CampaignDesign design;
  design.laterals_mm = {0, 100};
  design.fills_mm = {10, 40};
  Bench bench(design, sets, first_seed);
  fmt::print("{} observations, {} sets of each class, seeds from {}\n\n| what | goal | measured |\n|---|---|---|\n",
             bench.observations(), sets, first_seed);
  bench.nulls("null", "≤ 1 %", [](Rng&) { return Errors{}; });
  bench.nulls("null, errors scaled by 0.8–1.2", "≤ 2 %", [](Rng& rng) { return Errors{0.8 + 0.4 * rng.uniform()}; });
  bench.nulls("null, heavy tails", "≤ 2 %", [](Rng&) { return Errors{1.0, true}; });
  bench.several("single, s 3–5", 1, 3.0, 5.0, "", false);
  bench.several("single, s 5–8", 1, 5.0, 8.0, "95 %", false);
  bench.several("single, s 8–30", 1, 8.0, 30.0, "99 %", true);
  bench.several("pairs, s 8–30", 2, 8.0, 30.0, "95 %", true);
  bench.several("triples, s 8–30", 3, 8.0, 30.0, "85 %", true);
  bench.aliased();
  bench.unknowns(6.0, "≥ 50 %");
  bench.unknowns(8.0, "≥ 84 %");
  bench.unknowns(10.0, "≥ 98 %");
  row("time of one decision, median", "≤ 1 s", fmt::format("{:.2f} s", bench.median_seconds()));
}
