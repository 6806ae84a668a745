// The measurement of the paper's section III: the height of what is seen in a cup that stands at a known place.
#pragma once

#include <string_view>
#include <variant>

#include "detector/cloud.h"
#include "detector/liquid.h"
#include "diagnosis/measurement/laboratory_rig.h"

namespace fathom {

/// Why a cloud gives no height.
enum class NoHeight { no_desk, no_cup, too_little_inside };

std::string_view name_of(NoHeight reason);  ///< "no desk is seen", …

/// Mean height above the fitted desk of the points inside the cup that is nearest to `cup_in_world` [m], if it is
/// nearer than its outer radius.
std::variant<InteriorHeight, NoHeight> height_in_cup(const Cloud& cloud, const LaboratoryRig& rig,
                                                     const Eigen::Vector2d& cup_in_world);

}  // namespace fathom
