// Which sets of effects are worth ray tracing after few rays have screened all.
#pragma once

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/predict/physics.h"
#include "diagnosis/ray_traced/ray_tracer.h"

namespace fathom {

struct TracingPlan {
  std::vector<std::vector<std::string>> sets;  ///< the named one first
  std::size_t conditions = 0;                  ///< that will be traced, more or less
  std::size_t left_out = 0;                    ///< sets that would take too long
};

/// What was named; each effect that lets in light of which few rays know nothing; the likeliest sets of the ambiguity
/// set, of several that cannot be told apart the first; while all takes no more than some minutes of two processors.
TracingPlan plan_tracing(const Physics& physics, const Diagnosis& diagnosis, const RayTracer& tracer);

}  // namespace fathom
