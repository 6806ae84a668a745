// report.html of a diagnosis: what was found and what to do first, then where, before and after, which explanations are
// possible, what to measure next, and what could still hide.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/decision/diagnosis.h"
#include "diagnosis/statistics/evidence.h"
#include "report/shots.h"

namespace fathom {

struct DiagnosedCampaign {
  std::vector<std::string> folders;  ///< that were measured
  std::vector<Observation> observations;
  ReportShots shots;               ///< of the observations; may be empty
  std::vector<std::string> notes;  ///< what limits the measurement or the model of it, one sentence each
  Diagnosis diagnosis;
  std::string ray_traced_html;  ///< what ray tracing says of it; empty: few rays predicted all
};

/// Writes residuals.csv, heights.png, map.png (and their .gp and .svg) and report.html, which holds the pictures.
void write_diagnosis_report(const std::filesystem::path& folder, const DiagnosedCampaign& campaign);

}  // namespace fathom
