// A folder of measured clouds whose containers were labelled by eye, and what a detector makes of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/table.h"
#include "detector/detector.h"

namespace fathom {

/// One container of a scene, and the cup that was found where it stands, if any.
struct LabelledContainer {
  std::string scene, labels, object;
  bool on_desk;       ///< things on other things are not judged
  bool is_cup;        ///< upright and open; all else must not be taken for one
  double distance_m;  ///< of its axis from below the camera, along the desk
  std::optional<double> radius_m;
  std::optional<double> floor_m;  ///< of open ones whose floor is seen
  std::optional<DetectedCup> found;
  std::optional<double> seen_floor_m;  ///< by the detector, of cups and of open vessels that are none
  std::string reason;                  ///< why it is no cup, when it was seen
};

struct LabelledResult {
  int scenes = 0;
  std::vector<LabelledContainer> containers;
  std::vector<std::string> unlabelled;  ///< cups that were found where nothing is labelled: "SCENE at … mm"
};

inline constexpr const char* kLabelFile = "cups_groundtruth.csv";

/// Runs the method on every *.pcd and *.ply of the folder. cups_groundtruth.csv has the columns scene, labels, object
/// (mug_upright, cup_upright and tumbler_upright are cups), support ("table" counts), horiz_dist_m, and where known
/// circle_r_mm and inner_median_mm. A cup belongs to the container whose distance is within 20 mm of its own. Throws
/// Error when labels or clouds are missing.
LabelledResult evaluate_folder(const std::filesystem::path& folder, const Method& method,
                               const DetectorSettings& settings, bool quiet);

/// A row for each container and each unlabelled cup.
Table containers_table(const LabelledResult& result);

}  // namespace fathom
