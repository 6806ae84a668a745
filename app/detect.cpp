// fathom detect: cups and their liquids in clouds, as rows or as JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/detector_options.h"
#include "core/error.h"
#include "core/json.h"
#include "core/progress.h"
#include "core/units.h"
#include "detector/read_cloud.h"

namespace fathom {
namespace {

struct DetectOptions {
  std::vector<std::filesystem::path> clouds;
  std::string method{methods().front().name};
  DeskOptions desk;
  std::filesystem::path config;
};

Json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json optional_mm(const std::optional<double>& metres) { return metres ? Json(mm_from_metres(*metres)) : Json(); }

Json plane_json(const PlaneFit& desk) {
  return {{"normal", vector_json(desk.plane.normal)},
          {"offset_m", desk.plane.offset},
          {"height_mm", mm_from_metres(desk.plane.offset)},
          {"pitch_deg", deg_from_radians(pitch_above(desk.plane))},
          {"inliers", desk.inliers},
          {"rms_mm", mm_from_metres(desk.rms_m)}};
}

Json circle_json(const Candidate& candidate, const std::optional<TemplateMatch>& match) {
  const bool seen = candidate.circle.has_value();
  return {{"radius_mm", seen ? Json(mm_from_metres(candidate.circle->radius_m)) : Json()},
          {"rms_mm", seen ? Json(mm_from_metres(candidate.circle->rms_m)) : Json()},
          {"band_points", candidate.band_points},
          {"score", match ? Json(mm_from_metres(match->score_m)) : Json()},
          {"icp_iterations", match ? Json(match->iterations) : Json()}};
}

Json cup_json(const DetectedCup& cup) {
  Json json = {{"center_camera_m", vector_json(cup.center_in_camera)}};
  json.update(circle_json(cup.candidate, cup.match));
  json["liquid"] = name_of(cup.liquid);
  json["surface_mm"] = cup.interior ? Json(mm_from_metres(cup.interior->mean_m)) : Json();
  json["sigma_mm"] = cup.interior ? Json(mm_from_metres(cup.interior->standard_error_m())) : Json();
  json["sd_mm"] = cup.interior ? Json(mm_from_metres(cup.interior->sd_m)) : Json();
  json["points"] = cup.interior ? cup.interior->points : 0;
  json["kind"] = name_of(cup.kind);
  json["fill_mm"] = optional_mm(cup.fill_m);
  json["fill_sigma_mm"] = optional_mm(cup.fill_sigma_m);
  json["why"] = cup.why;
  return json;
}

Json detection_json(const Detection& detection) {
  Json json = {{"plane", detection.desk ? plane_json(*detection.desk) : Json()}, {"segments", detection.segments}};
  json["cups"] = Json::array();
  for (const DetectedCup& cup : detection.cups) json["cups"].push_back(cup_json(cup));
  json["candidates"] = Json::array();
  for (const RejectedSegment& segment : detection.rejected) {
    json["candidates"].push_back(circle_json(segment.candidate, segment.match));
    json["candidates"].back()["reason"] = segment.candidate.rejected;
  }
  if (!detection.desk) json["why"] = detection.why;
  return json;
}

std::string for_people(const std::filesystem::path& cloud, const Detection& detection) {
  if (!detection.desk) return fmt::format("{}\n  {}\n", cloud.string(), detection.why);
  const PlaneFit& desk = *detection.desk;
  std::string text = fmt::format("{}\n  desk  {:.1f} mm below the sensor, pitch {:.2f} deg, rms {:.2f} mm, {} points\n",
                                 cloud.string(), mm_from_metres(desk.plane.offset),
                                 deg_from_radians(pitch_above(desk.plane)), mm_from_metres(desk.rms_m), desk.inliers);
  text += fmt::format("  {} segments, {} cups\n", detection.segments, detection.cups.size());
  for (const DetectedCup& cup : detection.cups) {
    const Eigen::Vector3d& at = cup.center_in_camera;
    const std::string surface =
        cup.interior ? fmt::format("surface {:.1f} mm (sd {:.1f}, {} points)", mm_from_metres(cup.interior->mean_m),
                                   mm_from_metres(cup.interior->sd_m), cup.interior->points)
                     : "surface not seen";
    text += fmt::format("  cup   at {:.3f} {:.3f} {:.3f} m, radius {:.1f} mm, score {:.1f} mm, liquid {}, {}: {}\n",
                        at.x(), at.y(), at.z(), mm_from_metres(cup.candidate.circle->radius_m),
                        mm_from_metres(cup.match.score_m), name_of(cup.liquid), surface, cup.why);
  }
  for (const RejectedSegment& segment : detection.rejected)
    text += fmt::format("  other {} points: {}\n", segment.candidate.points.size(), segment.candidate.rejected);
  return text;
}

void run_detect(const DetectOptions& options, const CommonOptions& common) {
  const Method& method = method_named(options.method);
  DetectorSettings settings = detector_settings(options.config);
  settings.prior = options.desk.prior();

  Json all = Json::array();
  Progress progress("detect", options.clouds.size(), common.quiet || options.clouds.size() == 1);
  for (const std::filesystem::path& path : options.clouds) {
    const Detection detection = method.detect(read_cloud(path), settings);
    if (common.json && options.clouds.size() == 1) {
      all = detection_json(detection);
    } else if (common.json) {
      all.push_back({{"cloud", path.string()}});
      all.back().update(detection_json(detection));
    } else {
      fmt::print("{}", for_people(path, detection));
      std::fflush(stdout);  // into pipes too, while the next cloud is worked on
    }
    progress.step();
  }
  if (common.json) fmt::print("{}\n", all.dump(2));
}

}  // namespace

std::function<void()> define_detect(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<DetectOptions>();
  std::vector<std::string> names;
  std::string help = "One of";
  for (const Method& method : methods()) {
    names.emplace_back(method.name);
    help += fmt::format(" {} ({})", method.name, method.summary);
  }
  app.add_option("clouds", options->clouds, "PCD or PLY clouds, metres, camera frame")->required()->type_name("CLOUD");
  app.add_option("--method", options->method, help)->capture_default_str()->check([names](const std::string& name) {
    const bool known = std::find(names.begin(), names.end(), name) != names.end();
    return known ? std::string() : unknown_name("method", name, names);
  });
  add_desk_options(app, options->desk);
  app.add_option("--config", options->config, "Parameters of the method and its templates")->type_name("JSON");
  return [options, &common] { run_detect(*options, common); };
}

}  // namespace fathom
