#include "diagnosis/statistics/screen.h"

#include <algorithm>

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

class Screening {
 public:
  Screening(const Problem& problem, int keep, std::size_t largest) : problem_(problem), keep_(keep), best_(largest) {
    products_.emplace_back(problem, Leeway{});
    for (std::size_t effect = 0; effect < problem.columns.size(); ++effect) {
      is_seen_.push_back(!problem.sensitivities(Eigen::all, problem.columns[effect]).isZero(0.0));
      const Leeway& leeway = problem.leeways[effect];
      products_of_.push_back(leeway.log_det > 0.0 ? products_.size() : 0);
      if (leeway.log_det > 0.0) products_.emplace_back(problem, leeway);
    }
  }

  void extend(std::vector<int>& effects) {
    const int next = effects.empty() ? 0 : effects.back() + 1;
    for (int effect = next; effect < static_cast<int>(problem_.columns.size()); ++effect) {
      if (!is_seen_[effect]) continue;  // its best value is none in every set
      if (is_said(problem_, effects, effect)) continue;
      effects.push_back(effect);
      consider(effects);
      if (effects.size() < best_.size()) extend(effects);
      effects.pop_back();
    }
  }

  std::vector<Hypothesis> result() const {
    std::vector<Hypothesis> all;
    for (const auto& of_size : best_) all.insert(all.end(), of_size.begin(), of_size.end());
    return all;
  }

 private:
  void consider(const std::vector<int>& effects) {
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
      if (x.segment(first, count).isZero(0.0)) return;
      first += count;
    }
    found.gain = products.gain + x.dot(2.0 * b - G * x);
    found.log_evidence = log_evidence(problem_, found.gain, effects, x, G);
    const auto better = [](const Hypothesis& a, const Hypothesis& other) {
      return a.log_evidence > other.log_evidence;
    };
    auto& best = best_[effects.size() - 1];
    if (static_cast<int>(best.size()) == keep_ && !better(found, best.back())) return;
    best.insert(std::upper_bound(best.begin(), best.end(), found, better), std::move(found));
    if (static_cast<int>(best.size()) > keep_) best.pop_back();
  }

  const Problem& problem_;
  int keep_;
  std::vector<Products> products_;        // the first without leeway
  std::vector<std::size_t> products_of_;  // of each candidate
  std::vector<bool> is_seen_;
  std::vector<std::vector<Hypothesis>> best_;
};

}  // namespace

std::vector<Hypothesis> screen(const Problem& problem, int keep, std::size_t largest) {
  Screening screening(problem, keep, largest);
  std::vector<int> effects;
  screening.extend(effects);
  return screening.result();
}

}  // namespace fathom
