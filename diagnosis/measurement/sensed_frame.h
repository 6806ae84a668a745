// A frame's cloud as the estimators take it, and what in it cannot be what the notes say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "detector/cloud.h"
#include "diagnosis/measurement/frame_estimates.h"
#include "diagnosis/measurement/frames.h"
#include "diagnosis/measurement/unit_bias.h"

namespace fathom {

/// The measured points; of a cloud without rows each weighs as much of the image as it stands for.
std::vector<SensedPoint> sensed_points(const Cloud& cloud, const LaboratoryRig& rig);

/// Of a cloud's points those about the cup, and of the others, where there are many, every seventh pixel's with the
/// weight of seven.
std::vector<SensedPoint> with_desk_thinned(const Cloud& cloud, std::vector<SensedPoint> points,
                                           const LaboratoryRig& rig, const FrameView& view);

/// The same without what is known of the unit's bias: `bias` may be null.
std::vector<SensedPoint> without_bias(const Cloud& cloud, std::vector<SensedPoint> points, const LaboratoryRig& rig,
                                      const FrameView& view, const BiasField* bias);

/// Where the notes say that the cup stands, and how full.
FrameView view_of(const FrameRecord& frame);

/// Whether a fitted plane may be the desk that the rig stands on: within what the detector allows one.
bool is_near(const Plane& desk, const LaboratoryRig& rig);

/// Whether the desk is seen inside a cup whose bottom should stand clear of it.
bool shows_desk(const FrameEstimates& estimates, const LaboratoryRig& rig);

/// What clouds show that is otherwise than the notes say.
struct Misplaced {
  const char* column;   ///< of the table, that is wrong where most clouds are like that
  const char* finding;  ///< after "… clouds"
  const char* wanted;   ///< what that column must be
};
inline constexpr Misplaced kNoDesk{"cloud", "show no desk where rig.json says it is",
                                   "must be in metres in the camera's frame: x right, y down, z forward"};
inline constexpr Misplaced kNoCup{"distance_mm", "show the bare desk where distance_mm and lateral_mm say the cup is",
                                  "must be the places of the cup's axis in mm"};

/// "3 of 12 clouds show …", of the `clouds` that were read. Throws Error at the first of `rows` where they are most.
std::string finding_of(const Misplaced& what, const std::vector<std::size_t>& rows, std::size_t clouds,
                       const Table& table, std::string_view which = "clouds");

}  // namespace fathom
