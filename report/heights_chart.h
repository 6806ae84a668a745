// The heights' residuals as a chart in a page: each point says its condition, and leads to its shot.
#pragma once

#include <string>

#include "report/diagnosis_report.h"

namespace fathom {

/// Rows of heights by liquid, fill, distance and lateral: neighbours in a picture are neighbours in the campaign.
std::vector<std::size_t> heights_in_order(const std::vector<Observation>& observations);

/// An <svg> element; empty where there are no heights.
std::string heights_chart(const DiagnosedCampaign& campaign);

}  // namespace fathom
