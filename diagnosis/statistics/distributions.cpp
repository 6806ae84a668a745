#include "diagnosis/statistics/distributions.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace fathom {

namespace {

namespace bm = boost::math;
namespace policies = boost::math::policies;
// Tails too thin for a double are 0; no argument that passes the checks below is out of range.
using Quiet = policies::policy<policies::underflow_error<policies::ignore_error>,
                               policies::overflow_error<policies::ignore_error>, policies::promote_double<false>>;

constexpr double kLeastProbability = 1e-300;
double in_range(double p) { return std::clamp(p, kLeastProbability, 1.0 - std::numeric_limits<double>::epsilon()); }

}  // namespace

double normal_tail(double z) { return bm::cdf(bm::complement(bm::normal_distribution<double, Quiet>(), z)); }

double normal_quantile(double p) {
  return bm::quantile(bm::complement(bm::normal_distribution<double, Quiet>(), in_range(p)));
}

double student_quantile(double p, double dof) {
  return bm::quantile(bm::complement(bm::students_t_distribution<double, Quiet>(dof), in_range(p)));
}

double chi_squared_tail(double x, double dof) {
  return x <= 0.0 ? 1.0 : bm::cdf(bm::complement(bm::chi_squared_distribution<double, Quiet>(dof), x));
}

double normal_score(double t, double dof) {
  return (8.0 * dof + 1.0) / (8.0 * dof + 3.0) * std::sqrt(dof * std::log1p(t * t / dof));
}

double log_sum(const std::vector<double>& logs) {
  const double most = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(most)) return most;
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - most);
  return most + std::log(sum);
}

}  // namespace fathom
