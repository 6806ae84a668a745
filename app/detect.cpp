// fathom detect: cups and their liquids in clouds of files or of a device, as rows or as JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/LU>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/live_cloud.h"
#include "app/options.h"
#include "app/print.h"
#include "core/json.h"
#include "core/progress.h"
#include "detector/fuse.h"
#include "detector/read_cloud.h"
#include "detector/robust.h"
#include "detector/settings_json.h"
#include "diagnosis/measurement/calibrated_unit.h"
#include "report/detection_report.h"
#include "report/kept_detection.h"

namespace fathom {
namespace {

struct DetectOptions {
  std::vector<std::filesystem::path> clouds;
  std::optional<std::string> live;  ///< a device's URI; empty: the first one
  int frames = 1;                   ///< of the device
  std::string method{methods().front().name};
  DeskOptions desk;
  std::filesystem::path config;
  std::filesystem::path poses;
  std::filesystem::path unit;
  int keep_clouds = 10;
};

Pose read_pose(const JsonReader& json) {
  const std::vector<JsonReader> rows = json.items();
  if (rows.size() != 3) json.fail("must be three rows [r, r, r, metres]");
  Pose pose = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    const std::vector<double> row = rows[i].numbers();
    if (row.size() != 4) rows[i].fail("must be four numbers: a row of the rotation and a coordinate in metres");
    for (int k = 0; k < 3; ++k) pose.linear()(i, k) = row[k];
    pose.translation()[i] = row[3];
  }
  constexpr double kRounded = 1e-3;  // of numbers with four digits
  const Eigen::Matrix3d rotation = pose.linear();
  if (!(rotation * rotation.transpose()).isIdentity(kRounded) || rotation.determinant() < 0.0)
    json.fail("is no rotation: its rows must be orthogonal, of length 1 and right-handed");
  constexpr double kFarthest = 20.0;  // [m] cameras that look at one desk
  if (!(pose.translation().norm() < kFarthest))
    json.fail(fmt::format("must be in metres: its camera would stand {:.4g} m away", pose.translation().norm()));
  return pose;
}

/// Where the cameras of `count` clouds stood: {"world_from_camera": [[[r, r, r, x], [r, r, r, y], [r, r, r, z]], …]}
/// has for each the rows of its rotation and position [m]. Throws Error when rows are no rotation, or their number
/// differs.
std::vector<Pose> read_poses(const std::filesystem::path& path, std::size_t count) {
  const Json json = read_json(path);
  const JsonReader reader(json, path.string());
  reader.allow_only({"world_from_camera"});
  std::vector<Pose> poses;
  for (const JsonReader& item : reader.at("world_from_camera").items()) poses.push_back(read_pose(item));
  if (poses.size() != count)
    reader.fail_at("world_from_camera", fmt::format("has {} poses for {} clouds", poses.size(), count));
  return poses;
}

/// The measured points of all views in one frame.
Cloud joined(const std::vector<Cloud>& clouds, const std::vector<Pose>& world_from_view, const Pose& world_from_frame) {
  Cloud all;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Pose frame_from_view = world_from_frame.inverse() * world_from_view[i];
    for (const Eigen::Vector3f& point : finite_points(clouds[i]))
      all.points.push_back((frame_from_view * point.cast<double>()).cast<float>());
  }
  all.width = static_cast<int>(all.points.size());
  all.height = 1;
  return all;
}

/// All clouds as views of one desk.
void run_fused(const DetectOptions& options, const DetectorSettings& settings,
               const std::optional<CalibratedUnit>& unit, const CommonOptions& common) {
  const std::vector<Pose> poses = read_poses(options.poses, options.clouds.size());
  std::optional<KeptDetection> keeper;
  if (!common.output.empty()) keeper.emplace(common.output, options.keep_clouds);
  std::vector<PosedDetection> views;
  std::vector<Cloud> clouds;
  Json names = Json::array();
  Progress progress("detect", poses.size(), common.quiet);
  for (std::size_t i = 0; i < poses.size(); ++i, progress.step()) {
    Cloud cloud = read_cloud(options.clouds[i]);
    if (unit) unit->take_off_bias(cloud.points);
    views.push_back({detect_robust(cloud, settings), poses[i]});
    names.push_back(options.clouds[i].string());
    if (keeper) clouds.push_back(std::move(cloud));
  }
  const Detection detection = fuse_views(views, settings);
  Json json = {{"clouds", std::move(names)}};
  json.update(detection_json(detection));
  const std::string rows =
      common.json ? "" : format_rows(detection_rows(options.clouds.front().string(), detection), false);
  print_text(common.json ? json_text(json) : rows);
  if (!keeper) return;
  keeper->add(joined(clouds, poses, frame_of(views).world_from_camera));
  keeper->finish(json, rows);
}

/// Warns of a cloud that seems to be in millimetres, and of one in which no desk was found.
void warn_of(const std::string& name, const Cloud& cloud, const Detection& detection) {
  if (const std::string doubt = doubt_of_units(cloud); !doubt.empty())
    print_warning(fmt::format("{}: {}", name, doubt));
  if (!detection.desk) print_warning(fmt::format("{}: {}", name, detection.why));
}

void run_detect(const DetectOptions& options, const CommonOptions& common) {
  const Method& method = method_named(options.method);
  DetectorSettings settings = read_detector_settings(options.config);
  settings.prior = options.desk.prior();
  std::optional<CalibratedUnit> unit;
  if (!options.unit.empty()) unit.emplace(options.unit);
  if (!options.poses.empty()) return run_fused(options, settings, unit, common);

  const std::size_t count = options.live ? static_cast<std::size_t>(options.frames) : options.clouds.size();
  Progress progress("detect", count, common.quiet);
  std::optional<LiveCamera> camera;
  if (options.live) camera.emplace(*options.live);
  std::optional<KeptDetection> keeper;
  if (!common.output.empty()) keeper.emplace(common.output, options.keep_clouds);

  Json all = Json::array();
  std::string rows;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = camera ? camera->uri() : options.clouds[i].string();
    Cloud cloud = camera ? cloud_from_image(camera->next_cloud()) : read_cloud(options.clouds[i]);
    if (unit) unit->take_off_bias(cloud.points);
    const Detection detection = method.detect(cloud, settings);
    warn_of(name, cloud, detection);
    if (keeper) keeper->add(cloud);
    all.push_back({{"cloud", name}});
    all.back().update(detection_json(detection));
    if (!common.json) {
      const std::string text = format_rows(detection_rows(name, detection), false);
      print_text(text);
      std::fflush(stdout);  // into pipes too, while the next cloud is worked on
      rows += text;
    }
    progress.step();
  }
  const Json& json = count == 1 ? all.front() : all;
  if (common.json) print_text(json_text(json));
  if (keeper) keeper->finish(json, rows);
}

}  // namespace

std::function<void()> define_detect(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<DetectOptions>();
  CLI::Option* clouds =
      app.add_option("clouds", options->clouds, "PCD or PLY clouds, metres, camera frame")->type_name("CLOUD");
  CLI::Option* live =
      app.add_option("--live", options->live, "Frames of a device of OpenNI2, the first one or that URI")
          ->type_name("[URI]")
          ->expected(0, 1)
          ->default_str("")
          ->excludes(clouds);
  app.add_option("--frames", options->frames, "How many of the device's")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->needs(live);
  add_method_option(app, options->method);
  add_desk_options(app, options->desk);
  app.add_option("--config", options->config, "Parameters of the method and its templates")->type_name("JSON");
  app.add_option("--poses", options->poses,
                 "Takes the clouds as views of one desk: {\"world_from_camera\": [3 rows of 4 for each cloud]}, metres")
      ->type_name("JSON")
      ->excludes(live);
  app.add_option("--unit", options->unit, "What fathom calibrate found of the device: its bias is taken off the clouds")
      ->type_name("unit.json");
  app.add_option("--keep-clouds", options->keep_clouds, "How many clouds the folder of -o keeps, for fathom view")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  return [options, &common] {
    if (!options->poses.empty() && (options->clouds.empty() || options->method != "robust"))
      throw UsageError("--poses needs clouds and the method robust");
    if (options->clouds.empty() && !options->live) throw UsageError("needs a CLOUD or --live");
    run_detect(*options, common);
  };
}

}  // namespace fathom
