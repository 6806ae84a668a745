#include "diagnosis/statistics/screen.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "diagnosis/statistics/box_least_squares.h"

namespace fathom {

namespace {

constexpr int kReweighted = 3;   // times that the prior's pull is found anew where parameters are large, …
constexpr double kSmall = 0.05;  // … −2 log of their prior above this

/// All that fits ask of sensitivities and residual, whitened beside a leeway.
struct Products {
  Eigen::MatrixXd gram;
  Eigen::VectorXd projections;
  double gain;  ///< of the leeway alone

  Products(const Problem& problem, const Leeway& leeway) {
    const Eigen::MatrixXd sensitivities = leeway.whiten(problem.sensitivities);
    const Eigen::VectorXd residual = leeway.whiten(problem.residual);
    gram = sensitivities.transpose() * sensitivities;
    projections = sensitivities.transpose() * residual;
    gain = problem.residual.squaredNorm() - residual.squaredNorm() - leeway.log_det;
  }
};

/// What all sets are weighed by.
class Screening {
 public:
  explicit Screening(const Problem& problem) : problem_(problem) {
    products_.emplace_back(problem, Leeway{});
    for (std::size_t effect = 0; effect < problem.columns.size(); ++effect) {
      is_seen_.push_back(!problem.sensitivities(Eigen::all, problem.columns[effect]).isZero(0.0));
      const Leeway& leeway = problem.leeways[effect];
      products_of_.push_back(leeway.log_det > 0.0 ? products_.size() : 0);
      if (leeway.log_det > 0.0) products_.emplace_back(problem, leeway);
    }
  }

  /// Nothing of it can be told here, or a set says it already.
  bool adds_nothing(const std::vector<int>& effects, int effect) const {
    return !is_seen_[effect] || is_said(problem_, effects, effect);
  }

  /// Nothing where an effect's best value is none.
  std::optional<Hypothesis> weighed(const std::vector<int>& effects) const {
    const std::vector<Eigen::Index> columns = columns_of(problem_, effects);
    const Products& products = products_[products_of_[widest_leeway(problem_, effects)]];
    const Eigen::MatrixXd G = products.gram(columns, columns);
    const Eigen::VectorXd b = products.projections(columns);
    Hypothesis found{effects, Eigen::VectorXd::Zero(b.size())};
    Eigen::VectorXd& x = found.parameters;
    for (int step = 0; step < kReweighted; ++step) {
      Eigen::MatrixXd with_prior = G;
      with_prior.diagonal() += prior_precisions(x);
      x = box_least_squares(with_prior, b, problem_.lower(columns), problem_.upper(columns));
      if (prior_penalty(x) < kSmall) break;
    }
    Eigen::Index first = 0;
    for (const int effect : effects) {
      const auto count = static_cast<Eigen::Index>(problem_.columns[effect].size());
      if (x.segment(first, count).isZero(0.0)) return std::nullopt;
      first += count;
    }
    found.gain = products.gain + x.dot(2.0 * b - G * x);
    found.log_evidence = log_evidence(problem_, found.gain, effects, x, G);
    return found;
  }

 private:
  const Problem& problem_;
  std::vector<Products> products_;        // the first without leeway
  std::vector<std::size_t> products_of_;  // of each candidate
  std::vector<bool> is_seen_;
};

/// The likeliest sets of one size, likeliest first; of equals those that came first.
class BestSets {
 public:
  explicit BestSets(int keep) : keep_(static_cast<std::size_t>(keep)) {}

  void offer(Hypothesis set) {
    const auto likelier = [](const Hypothesis& a, const Hypothesis& b) { return a.log_evidence > b.log_evidence; };
    if (sets_.size() == keep_ && !likelier(set, sets_.back())) return;
    sets_.insert(std::upper_bound(sets_.begin(), sets_.end(), set, likelier), std::move(set));
    if (sets_.size() > keep_) sets_.pop_back();
  }

  const std::vector<Hypothesis>& sets() const { return sets_; }

 private:
  std::size_t keep_;
  std::vector<Hypothesis> sets_;
};

/// A set, and all larger ones that begin with it.
void extend(const Screening& screening, int candidates, std::vector<int>& effects, std::vector<BestSets>& of_size) {
  if (std::optional<Hypothesis> found = screening.weighed(effects))
    of_size[effects.size() - 1].offer(*std::move(found));
  if (effects.size() == of_size.size()) return;
  for (int effect = effects.back() + 1; effect < candidates; ++effect) {
    if (screening.adds_nothing(effects, effect)) continue;
    effects.push_back(effect);
    extend(screening, candidates, effects, of_size);
    effects.pop_back();
  }
}

}  // namespace

std::vector<Hypothesis> screen(const Problem& problem, int keep, std::size_t largest) {
  const Screening screening(problem);
  const auto candidates = static_cast<int>(problem.columns.size());
  const std::vector<BestSets> none(largest, BestSets(keep));
  std::vector<std::vector<BestSets>> by_first(problem.columns.size(), none);
  parallel_items(candidates, [&](int first) {
    std::vector<int> effects{first};
    if (!screening.adds_nothing({}, first)) extend(screening, candidates, effects, by_first[first]);
  });
  std::vector<Hypothesis> result;
  for (std::size_t size = 0; size < largest; ++size) {
    BestSets best(keep);
    for (std::vector<BestSets>& of_size : by_first)
      for (const Hypothesis& set : of_size[size].sets()) best.offer(set);
    result.insert(result.end(), best.sets().begin(), best.sets().end());
  }
  return result;
}

}  // namespace fathom
