// report.html of a diagnosis: the sentence first, then where, before and after, what else it could be, what could still
// hide, and what to measure next.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/evidence.h"
#include "report/shots.h"

namespace fathom {

struct DiagnosedCampaign {
  std::string name;  ///< of its folder
  std::vector<Observation> observations;
  ReportShots shots;               ///< of the observations; may be empty
  std::vector<std::string> notes;  ///< what limits the measurement or the model of it, one sentence each
  Diagnosis diagnosis;
  std::string ray_traced_html;  ///< what ray tracing says of it; empty: few rays predicted all
};

/// Writes residuals.csv, heights.png, map.png (and their .gp and .svg) and report.html, which holds the pictures.
void write_diagnosis_report(const std::filesystem::path& folder, const DiagnosedCampaign& campaign);

}  // namespace fathom
