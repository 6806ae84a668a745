// report.json of `diagnose`.
#pragma once

#include "core/json_fwd.h"
#include "diagnosis/decision/diagnosis.h"

namespace fathom {

Json json_from(const GapSize& gap);
Json json_from(const Diagnosis& diagnosis);

}  // namespace fathom
