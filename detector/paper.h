// The method as printed: Hara, Honda, Tsubouchi & Ohya, IROS 2014, section V.
#pragma once

#include <variant>

#include "detector/detector.h"

namespace fathom {

/// A cup's centre is told at this height above the desk: the middle of the paper's band.
inline constexpr double kCenterHeightMetres = 0.045;

/// A scene with its desk found: what is left to do happens in the desk's frame.
struct DeskView {
  PlaneFit desk;
  Eigen::Isometry3d desk_from_camera;
  Points points;  ///< [m] desk frame, all measured points
};

std::variant<DeskView, NoDesk> view_of_desk(const Cloud& cloud, const std::optional<DeskPrior>& prior,
                                            const PlaneSearch& search);

/// The segments on the desk, examined: those with an empty `rejected` may be cups.
std::vector<Candidate> cup_candidates(const DeskView& view, const PaperConfig& config);

Detection detect_paper(const Cloud& cloud, const DetectorSettings& settings);

}  // namespace fathom
