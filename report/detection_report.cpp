#include "report/detection_report.h"

#include <fmt/format.h>

#include "core/units.h"

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

Json cup_json(const DetectedCup& cup) {
  Json json = {{"center_camera_m", vector_json(cup.center_in_camera)}};
  json.update(circle_json(cup.candidate, cup.match));
  json["radius_sigma_mm"] = optional_mm(cup.radius_sigma_m);
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
  for (const RejectedSegment& segment : detection.rejected) {
    json["candidates"].push_back(circle_json(segment.candidate, segment.match));
    json["candidates"].back()["score"] = segment.match ? Json(mm_from_metres(segment.match->score_m)) : Json();
    json["candidates"].back()["surface_mm"] =
        segment.interior ? Json(mm_from_metres(segment.interior->mean_m)) : Json();
    json["candidates"].back()["reason"] = segment.candidate.rejected;
  }
  if (!detection.desk) json["why"] = detection.why;
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
