// A known cup: its points as a camera saw them, and from which height on its content is a liquid.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json_fwd.h"
#include "detector/cup_gates.h"
#include "detector/liquid.h"

namespace fathom {

/// A bottom that reads higher than the empty cup's by this is raised: the paper's 9 mm over a bottom at 7 mm.
inline constexpr double kThresholdAboveBottomMetres = 0.002;

struct CupTemplate {
  std::string name;
  Points points;  ///< [m] origin on the desk below the cup's axis, z up, y away from the camera that saw it
  double liquid_threshold_m;
  double height_m;
  double radius_m;
  std::optional<double> bottom_sigma_m{};  ///< of the mean height of its bottom, where that was seen and is told
};

/// As templates are: the mean of the points in each cube of 3 mm.
Points thinned(const Points& points);

/// Points of the desk frame in the frame of a template: `circle`'s centre becomes the origin, its direction from the
/// camera's foot point the y axis.
Points in_template_frame(const Points& in_desk, const Circle& circle);

/// Reads NAME.json and the cloud beside it.
CupTemplate load_template(const std::filesystem::path& json);

/// The keys of NAME.json.
std::vector<KeyTable> template_key_tables();

/// Every *.json of the folder, by name. Throws Error when there is none.
std::vector<CupTemplate> load_templates(const std::filesystem::path& folder);

/// Writes NAME.pcd, then NAME.json, into the folder.
void save_template(const std::filesystem::path& folder, const CupTemplate& cup);

}  // namespace fathom
