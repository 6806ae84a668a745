#include "core/sampling.h"

#include <algorithm>
#include <cassert>

#include "core/parallel.h"

namespace fathom {
namespace {

constexpr std::uint64_t kBatch = 256;         ///< samples that one thread takes at once
constexpr std::uint64_t kBatchesAtOnce = 64;  ///< between two reports
constexpr std::uint64_t kFirst = 4096;        ///< samples before the errors are looked at

struct Batch {
  std::vector<Mean> means;
  std::uint64_t work = 0;
};

Batch run_batch(std::uint64_t begin, std::uint64_t end, std::size_t quantities, const Sampler& sampler) {
  Batch batch{std::vector<Mean>(quantities), 0};
  std::vector<double> values(quantities);
  for (std::uint64_t sample = begin; sample < end; ++sample) {
    std::fill(values.begin(), values.end(), 0.0);
    batch.work += sampler(sample, values);
    for (std::size_t i = 0; i < quantities; ++i) batch.means[i].add(values[i]);
  }
  return batch;
}

/// Samples that the worst quantity needs, judging by what is known of it.
double samples_needed(const SamplingPlan& plan, const std::vector<Mean>& means) {
  double needed = 0.0;
  for (std::size_t i = 0; i < (plan.judged > 0 ? plan.judged : means.size()); ++i) {
    const Estimate found = means[i].estimate();
    const double samples = static_cast<double>(means[i].count());
    const double error = found.value == 0.0 ? 1.0 / samples : found.standard_error;
    const double goal = std::max(plan.absolute_error, plan.relative_error * std::fabs(found.value));
    needed = std::max(needed, samples * (error / goal) * (error / goal));
  }
  return needed;
}

}  // namespace

SamplingResult sample_until(const SamplingPlan& plan, std::size_t quantities, const Sampler& sampler) {
  assert(plan.samples != 1);
  std::vector<Mean> means(quantities);
  SamplingResult result;
  std::uint64_t work = 0;
  std::uint64_t goal = plan.samples > 0 ? plan.samples : kFirst;
  while (result.samples < goal) {
    const std::uint64_t begin = result.samples, end = std::min(goal, begin + kBatchesAtOnce * kBatch);
    std::vector<Batch> batches((end - begin + kBatch - 1) / kBatch);
    parallel_items(static_cast<int>(batches.size()), [&](int i) {
      const std::uint64_t from = begin + static_cast<std::uint64_t>(i) * kBatch;
      batches[static_cast<std::size_t>(i)] = run_batch(from, std::min(end, from + kBatch), quantities, sampler);
    });
    for (const Batch& batch : batches) {
      for (std::size_t i = 0; i < quantities; ++i) means[i].add(batch.means[i]);
      work += batch.work;
    }
    result.samples = end;
    if (plan.report) plan.report(result.samples, goal);
    if (plan.samples > 0) continue;
    if (work >= plan.most_work) break;
    if (result.samples < goal) continue;
    const double needed = samples_needed(plan, means);
    if (needed <= static_cast<double>(result.samples)) break;
    // An error known from few samples is itself uncertain: grow at most fourfold, and a little beyond the estimate.
    goal = static_cast<std::uint64_t>(std::min(1.05 * needed, 4.0 * static_cast<double>(result.samples)));
  }
  for (const Mean& mean : means) result.quantities.push_back(mean.estimate());
  result.reached = plan.samples > 0 || samples_needed(plan, means) <= static_cast<double>(result.samples);
  return result;
}

}  // namespace fathom
