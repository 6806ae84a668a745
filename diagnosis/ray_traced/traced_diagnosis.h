// The diagnosis by ray tracing, after that by few rays.
#pragma once

#include "diagnosis/decision/decide.h"
#include "diagnosis/decision/gap_size.h"
#include "diagnosis/predict/physics.h"
#include "diagnosis/ray_traced/traced_evidence.h"

namespace fathom {

struct RayTracedDiagnosis {
  Diagnosis diagnosis;                    ///< of the observations below; u_num is the few rays' difference
  std::vector<Observation> observations;  ///< that frames show
  std::vector<TracedSet> sets;            ///< that was named before first
  std::vector<LeftOutLevel> left_out;     ///< of what is named
  std::size_t not_seen = 0;               ///< observations that frames do not show
  std::size_t not_traced = 0;             ///< sets that would have taken too long
};

/// Decides again, with predictions of whole frames for what is and for the sets that few rays left: the named one, each
/// effect that lets in light, and the likeliest of the ambiguity set, as far as time allows. The same for any number of
/// threads.
RayTracedDiagnosis ray_traced_diagnosis(const Physics& physics, const Diagnosis& by_few_rays, const Designs& designs,
                                        const DecisionSettings& settings, bool quiet);

}  // namespace fathom
