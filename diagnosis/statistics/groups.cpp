#include "diagnosis/statistics/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace fathom {

std::vector<std::vector<Eigen::Index>> Groups::members() const {
  std::vector<std::vector<Eigen::Index>> result(count);
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i] >= 0) result[of[i]].push_back(static_cast<Eigen::Index>(i));
  return result;
}

Groups group_by(const std::vector<Observation>& observations,
                const std::function<std::string(const Observation&)>& key) {
  Groups groups;
  std::unordered_map<std::string, int> numbers;
  for (const Observation& observation : observations) {
    const std::string name = key(observation);
    if (name.empty()) {
      groups.of.push_back(-1);
      continue;
    }
    const auto [entry, is_new] = numbers.emplace(name, groups.count);
    groups.count += is_new;
    groups.of.push_back(entry->second);
  }
  return groups;
}

bool has_cup(const Factors& factors) { return factors.liquid != "none"; }
bool has_liquid(const Factors& factors) { return has_cup(factors) && factors.liquid != "empty"; }

std::string session_key(const Observation& o) { return fmt::format("{}", o.factors.session); }

std::string pour_of(const Factors& f) {
  return has_liquid(f) ? fmt::format("{}/{} of {}, {} mm", f.session, f.pour, f.liquid, f.fill_mm) : "";
}

std::string pour_key(const Observation& o) { return pour_of(o.factors); }

std::string placement_key(const Observation& o) {
  if (!has_cup(o.factors)) return fmt::format("{}/bare desk", o.factors.session);
  return fmt::format("{}/{}/{}/{}", o.factors.session, o.factors.pour, o.factors.placement, condition_key(o));
}

std::string condition_key(const Observation& o) {
  if (o.is_of_session) return fmt::format("{}", has_cup(o.factors) ? "cups" : "bare desk");
  return fmt::format("{}, {} mm, at ({}, {}) mm", o.factors.liquid, o.factors.fill_mm, o.factors.lateral_mm,
                     o.factors.distance_mm);
}

std::string cell_key(const Observation& o) {
  return fmt::format("{}/{}/{}", condition_key(o), o.observable, o.factors.region);
}

const std::vector<std::string>& factor_names() {
  static const std::vector<std::string> names{"liquid", "fill_mm", "distance_mm", "lateral_mm", "region", "session"};
  return names;
}

std::string level(const Observation& o, const std::string& factor) {
  if (factor == "region") return o.factors.region;
  if (factor == "session" && !o.factors.within_mm) return session_key(o);
  if (factor == "liquid") return o.is_of_session && has_cup(o.factors) ? std::string() : o.factors.liquid;
  if (o.factors.within_mm || o.is_of_session) return {};  // a mean over all of these
  if (factor == "fill_mm") return fmt::format("{}", o.factors.fill_mm);
  if (factor == "distance_mm") return fmt::format("{}", o.factors.distance_mm);
  return fmt::format("{}", o.factors.lateral_mm);
}

Eigen::MatrixXd places_in_ranges(const std::vector<Observation>& observations) {
  const auto n = static_cast<Eigen::Index>(observations.size());
  Eigen::MatrixXd x(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Factors& factors = observations[i].factors;
    x.row(i) << factors.fill_mm, factors.distance_mm, factors.lateral_mm;
  }
  std::vector<Eigen::Index> cups, others;  // a bare desk is at no place, nor is the mean of all placements
  for (Eigen::Index i = 0; i < n; ++i)
    (has_cup(observations[i].factors) && !observations[i].is_of_session ? cups : others).push_back(i);
  if (cups.empty()) return Eigen::MatrixXd::Zero(n, 3);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::VectorXd own = x(cups, k);
    const double low = own.minCoeff(), range = own.maxCoeff() - low;
    x.col(k) = ((x.col(k).array() - low) / std::max(range, 1e-12)).max(0.0).min(1.0);
  }
  x(others, Eigen::all).setZero();
  return x;
}

bool is_height(const Observation& o) { return o.observable.ends_with("height_mm"); }

}  // namespace fathom
