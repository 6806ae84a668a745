#include "report/detection_report.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/json.h"
#include "core/units.h"
#include "detector/cone.h"

namespace fathom {
namespace {

Json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json optional_mm(const std::optional<double>& metres) { return metres ? Json(mm_from_metres(*metres)) : Json(); }

/// Of the mean height inside.
std::optional<double> sigma_of(const DetectedCup& cup) {
  if (!cup.interior) return std::nullopt;
  return cup.surface_sigma_m ? cup.surface_sigma_m : cup.interior->standard_error_m();
}

Json plane_json(const PlaneFit& desk) {
  return {{"normal", vector_json(desk.plane.normal)},
          {"offset_m", desk.plane.offset},
          {"height_mm", mm_from_metres(desk.plane.offset)},
          {"pitch_deg", deg_from_radians(pitch_above(desk.plane))},
          {"inliers", desk.inliers},
          {"rms_mm", mm_from_metres(desk.rms_m)}};
}

Json circle_json(const CupCandidate& candidate, const std::optional<TemplateMatch>& match) {
  const bool seen = candidate.circle.has_value();
  return {{"radius_mm", seen ? Json(mm_from_metres(candidate.circle->radius_m)) : Json()},
          {"rms_mm", seen ? Json(mm_from_metres(candidate.circle->rms_m)) : Json()},
          {"band_points", candidate.band_points},
          {"icp_iterations", match ? Json(match->iterations) : Json()}};
}

/// Where something stands on the desk, and how much room it takes.
struct Room {
  Eigen::Vector2d middle;  ///< [m] desk frame
  double width_m, height_m;
};

/// By the circle, or by the points where there is none.
Room room_of(const CupCandidate& candidate) {
  if (candidate.circle) return {candidate.circle->center, candidate.width_m, candidate.top_m};
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : candidate.points) box.extend(point);
  const Eigen::Vector2f middle = box.center().head<2>();
  float reach = 0.0f;
  for (const Eigen::Vector3f& point : candidate.points) reach = std::max(reach, (point.head<2>() - middle).norm());
  return {middle.cast<double>(), 2.0 * reach, box.max().z()};
}

Json candidate_json(const RejectedSegment& segment, const Eigen::Isometry3d& camera_from_desk) {
  const Room room = room_of(segment.candidate);
  Json json = {{"center_camera_m",
                vector_json(camera_from_desk * Eigen::Vector3d(room.middle.x(), room.middle.y(), kWallHeight))},
               {"width_mm", mm_from_metres(room.width_m)},
               {"height_mm", mm_from_metres(room.height_m)}};
  json.update(circle_json(segment.candidate, segment.match));
  json["score"] = segment.match ? Json(mm_from_metres(segment.match->score_m)) : Json();
  json["surface_mm"] = segment.interior ? Json(mm_from_metres(segment.interior->mean_m)) : Json();
  json["reason"] = segment.candidate.rejected;
  return json;
}

Json cup_json(const DetectedCup& cup) {
  Json json = {{"center_camera_m", vector_json(cup.center_in_camera)}};
  json.update(circle_json(cup.candidate, cup.match));
  json["radius_sigma_mm"] = optional_mm(cup.radius_sigma_m);
  json["height_mm"] = mm_from_metres(cup.candidate.top_m);
  json["lean_deg"] = cup.candidate.lean ? Json(deg_from_radians(std::atan(*cup.candidate.lean))) : Json();
  json["score"] = mm_from_metres(cup.score_m);
  json["liquid"] = name_of(cup.liquid);
  json["p_liquid"] = cup.p_liquid ? Json(*cup.p_liquid) : Json();
  json["surface_mm"] = cup.interior ? Json(mm_from_metres(cup.interior->mean_m)) : Json();
  json["sigma_mm"] = optional_mm(sigma_of(cup));
  json["sd_mm"] = cup.interior ? Json(mm_from_metres(cup.interior->sd_m)) : Json();
  json["points"] = cup.interior ? cup.interior->points : 0;
  json["bottom_mm"] = optional_mm(cup.bottom_m);
  json["kind"] = name_of(cup.kind);
  json["fill_mm"] = optional_mm(cup.fill_m);
  json["fill_sigma_mm"] = optional_mm(cup.fill_sigma_m);
  json["why"] = cup.why;
  return json;
}

void add_cup_rows(const std::string& name, const DetectedCup& cup, std::vector<Row>& rows) {
  const Eigen::Vector3d& center = cup.center_in_camera;
  rows.insert(rows.end(), {{name + "_center_x", center.x(), "m"},
                           {name + "_center_y", center.y(), "m"},
                           {name + "_center_z", center.z(), "m"},
                           {name + "_radius", mm_from_metres(cup.candidate.circle->radius_m), "mm"},
                           {name + "_score", mm_from_metres(cup.score_m), "mm"},
                           {name + "_liquid", std::string(name_of(cup.liquid))}});
  if (cup.p_liquid) rows.push_back({name + "_p_liquid", *cup.p_liquid});
  if (cup.interior)
    rows.insert(rows.end(), {{name + "_surface", mm_from_metres(cup.interior->mean_m), "mm"},
                             {name + "_sigma", mm_from_metres(*sigma_of(cup)), "mm"},
                             {name + "_points", static_cast<double>(cup.interior->points)}});
  rows.push_back({name + "_kind", std::string(name_of(cup.kind))});
  if (cup.fill_m) rows.push_back({name + "_fill", mm_from_metres(*cup.fill_m), "mm"});
  if (cup.fill_sigma_m) rows.push_back({name + "_fill_sigma", mm_from_metres(*cup.fill_sigma_m), "mm"});
  rows.push_back({name + "_why", cup.why});
}

}  // namespace

Json detection_json(const Detection& detection) {
  Json json = {{"plane", detection.desk ? plane_json(*detection.desk) : Json()}, {"segments", detection.segments}};
  json["cups"] = Json::array();
  for (const DetectedCup& cup : detection.cups) json["cups"].push_back(cup_json(cup));
  json["candidates"] = Json::array();
  if (!detection.desk) {
    json["why"] = detection.why;
    return json;
  }
  const Eigen::Isometry3d camera_from_desk = desk_from_camera(detection.desk->plane).inverse();
  for (const RejectedSegment& segment : detection.rejected)
    json["candidates"].push_back(candidate_json(segment, camera_from_desk));
  return json;
}

std::vector<Row> detection_rows(const std::string& cloud, const Detection& detection) {
  std::vector<Row> rows{{"cloud", cloud}};
  if (!detection.desk) {
    rows.push_back({"why", detection.why});
    return rows;
  }
  const PlaneFit& desk = *detection.desk;
  rows.insert(rows.end(), {{"desk_height", mm_from_metres(desk.plane.offset), "mm"},
                           {"desk_pitch", deg_from_radians(pitch_above(desk.plane)), "deg"},
                           {"desk_rms", mm_from_metres(desk.rms_m), "mm"},
                           {"desk_inliers", static_cast<double>(desk.inliers)},
                           {"segments", static_cast<double>(detection.segments)},
                           {"cups", static_cast<double>(detection.cups.size())}});
  for (std::size_t i = 0; i < detection.cups.size(); ++i)
    add_cup_rows(fmt::format("cup{}", i), detection.cups[i], rows);
  for (std::size_t i = 0; i < detection.rejected.size(); ++i)
    rows.push_back({fmt::format("candidate{}_why", i), detection.rejected[i].candidate.rejected});
  return rows;
}

}  // namespace fathom
