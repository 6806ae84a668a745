// What the model leaves of a campaign, before and after effects were added: as a table and as pictures.
#pragma once

#include "report/diagnosis_report.h"

namespace fathom {

/// residuals.csv: every observation with its factors, measured minus predicted, 1 σ of that, and its pixels.
void write_residuals(const std::filesystem::path& folder, const DiagnosedCampaign& campaign);

/// heights.png: the heights' residuals over the campaign, liquid by liquid. False when there are no heights.
bool draw_heights(const std::filesystem::path& folder, const DiagnosedCampaign& campaign);

struct MapPicture {
  bool is_drawn = false;
  bool has_unseen = false;  ///< parts of the cup without a height, which are grey
};
/// map.png: mean residual in each region of the cup and of the desk. Not drawn when heights are all there is.
MapPicture draw_map(const std::filesystem::path& folder, const DiagnosedCampaign& campaign);

/// shape.png: residuals of the shape of what is seen in the cup, liquid by liquid. False where none was measured.
bool draw_shape(const std::filesystem::path& folder, const DiagnosedCampaign& campaign);

/// sessions.png: residuals of the camera's height above the desk over sessions and time. False where there is only one
/// time, or no such height.
bool draw_sessions(const std::filesystem::path& folder, const DiagnosedCampaign& campaign);

}  // namespace fathom
