// The heights' residuals as a chart in a page: each point says its condition, and leads to its cloud.
#pragma once

#include <string>

#include "app/diagnosis_report.h"

namespace fathom {

/// An <svg> element; empty where there are no heights.
std::string heights_chart(const DiagnosedCampaign& campaign);

}  // namespace fathom
