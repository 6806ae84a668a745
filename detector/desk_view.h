// A scene seen from its desk, and the segments that stand on it. Paper, sections V-A to V-D.
#pragma once

#include <variant>

#include "detector/paper_config.h"

namespace fathom {

/// A scene with its desk found: what is left to do happens in the desk's frame.
struct DeskView {
  PlaneFit desk;
  Eigen::Isometry3d desk_from_camera;
  Points points;  ///< [m] desk frame, all measured points
};

/// `measured` [m, camera frame]: finite.
DeskView view_over(const PlaneFit& desk, Points measured);

/// Over the plane that the paper's search chooses.
std::variant<DeskView, NoDesk> view_of_desk(const Cloud& cloud, const std::optional<DeskPrior>& prior,
                                            const PlaneSearch& search);

/// The segments on the desk, examined: those with an empty `rejected` may be cups.
std::vector<CupCandidate> cup_candidates(const DeskView& view, const PaperConfig& config);

}  // namespace fathom
