// What ray tracing adds to a diagnosis' report: which effects few rays may stand for, and what they had said.
#pragma once

#include "core/json.h"
#include "diagnosis/ray_traced/traced_diagnosis.h"

namespace fathom {

/// Adds "cosine" and "fit" to the effects of report.json, and "ray_traced" and "geometric".
void add_ray_traced(const RayTracedDiagnosis& traced, const Diagnosis& by_few_rays, Json& report);

/// The same for report.html.
std::string ray_traced_html(const RayTracedDiagnosis& traced, const Diagnosis& by_few_rays);

}  // namespace fathom
