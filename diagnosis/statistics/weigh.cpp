#include "diagnosis/statistics/weigh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/statistics/options.h"

namespace fathom {

namespace {

/// What a test that rejects with p says at most against what it rejects: a bound on the Bayes factor (Sellke, Bayarri &
/// Berger 2001, The American Statistician 55, 62).
double log_bayes_factor(double p) {
  const double log_p = std::log(std::max(p, std::numeric_limits<double>::min()));
  return log_p < -1.0 ? 1.0 + log_p + std::log(-log_p) : 0.0;
}

/// Of the posteriors of those options that have something unknown, or do not.
double log_sum(const std::vector<Option>& options, bool has_unknown) {
  const double best = likeliest(options).log_posterior;
  double sum = 0.0;
  for (const Option& o : options)
    if (o.has_unknown == has_unknown) sum += std::exp(o.log_posterior - best);
  return best + std::log(sum);
}

/// What is small beside something unknown is not told from it.
void take_out_parts_of_rest(const Case& c, const Refit& nothing, Weighed& weighed) {
  const std::vector<int> parts = parts_of_rest(c, *weighed.choice, weighed.rest);
  std::erase_if(weighed.options, [&](const Option& o) { return o.has_unknown && holds_any(o.effects, parts); });
  if (parts.empty()) return;
  weighed.choice = without(c, *weighed.choice, parts);
  weighed.rest = rest_of(c, weighed.choice ? weighed.choice->fit : nothing);
}

/// Where something is chosen nothing at all is rejected, and so is what moves nothing; where nothing is left, something
/// unknown; where something is left, more or less, what knows of nothing unknown.
void reject(const Case& c, Weighed& weighed) {
  std::vector<Option>& options = weighed.options;
  if (weighed.choice)
    std::erase_if(options, [](const Option& o) { return o.prediction.isZero(0.0) && !o.has_unknown; });
  if (weighed.rest.p >= c.settings.p_gap) std::erase_if(options, [](const Option& o) { return o.has_unknown; });
  if (!weighed.is_rest) return;
  // What tests find may have another shape than the smooth ones by which something unknown is weighed.
  const double against = log_bayes_factor(weighed.p_rest);
  const double most = log_sum(options, true) - kLogPriorUnknown + against;
  const double change = std::min(against, most - log_sum(options, false));
  for (Option& o : options)
    if (!o.has_unknown) o.log_posterior += change;
}

}  // namespace

Weighed weigh(const Case& c) {
  const std::vector<Hypothesis> hypotheses = screened(c);
  const std::vector<Refit> fits = likeliest_fits(c, hypotheses);
  const Refit& nothing =
      *std::find_if(fits.begin(), fits.end(), [](const Refit& f) { return f.hypothesis.effects.empty(); });
  const double p_rest_of_likeliest = rest_of(c, fits.front()).p;
  Weighed weighed{.options = options_of(c, hypotheses, fits), .choice = choose(c, fits), .fit = {}, .rest = {}};
  weighed.rest = rest_of(c, weighed.choice ? weighed.choice->fit : nothing);
  if (!weighed.choice || weighed.rest.p < c.settings.p_gap)
    if (auto common = common_to_all(c, fits, weighed.options, p_rest_of_likeliest < c.settings.p_gap)) {
      weighed.choice = std::move(common);
      weighed.rest = rest_of(c, weighed.choice->fit);
    }
  // What no test confirms may yet explain the gap: unknown is what the likeliest effects leave, too.
  weighed.p_rest = std::max(weighed.rest.p, p_rest_of_likeliest);
  weighed.is_rest = weighed.p_rest < c.settings.p_gap;
  if (weighed.choice && weighed.is_rest) take_out_parts_of_rest(c, nothing, weighed);
  weighed.fit = weighed.choice ? weighed.choice->fit : nothing;
  reject(c, weighed);
  return weighed;
}

}  // namespace fathom
