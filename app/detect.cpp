// fathom detect: cups and their liquids in clouds of files or of a device, as rows or as JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/detector_options.h"
#include "app/live_cloud.h"
#include "app/poses.h"
#include "app/print.h"
#include "app/results.h"
#include "core/json_text.h"
#include "core/progress.h"
#include "detector/detector_settings.h"
#include "detector/fuse.h"
#include "detector/read_cloud.h"
#include "detector/robust.h"
#include "report/detection_report.h"

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
};

/// All clouds as views of one desk.
void run_fused(const DetectOptions& options, const DetectorSettings& settings, const CommonOptions& common) {
  const std::vector<Pose> poses = read_poses(options.poses, options.clouds.size());
  std::vector<PosedDetection> views;
  Progress progress("detect", poses.size(), common.quiet || poses.size() == 1);
  for (std::size_t i = 0; i < poses.size(); ++i, progress.step())
    views.push_back({detect_robust(read_cloud(options.clouds[i]), settings), poses[i]});
  const Detection detection = fuse_views(views, settings);
  if (common.json)
    print_results(common, "detection", ".json", json_text(detection_json(detection)));
  else
    print_results(common, "detection", ".txt",
                  format_rows(detection_rows(options.clouds.front().string(), detection), false));
}

void run_detect(const DetectOptions& options, const CommonOptions& common) {
  const Method& method = method_named(options.method);
  DetectorSettings settings = detector_settings(options.config);
  settings.prior = options.desk.prior();
  if (!options.poses.empty()) return run_fused(options, settings, common);

  std::optional<LiveCamera> camera;
  if (options.live) camera.emplace(*options.live);
  const std::size_t count = camera ? static_cast<std::size_t>(options.frames) : options.clouds.size();

  Json all = Json::array();
  std::string rows;
  Progress progress("detect", count, common.quiet || count == 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = camera ? camera->uri() : options.clouds[i].string();
    const Cloud cloud = camera ? cloud_from_image(camera->next_cloud()) : read_cloud(options.clouds[i]);
    const Detection detection = method.detect(cloud, settings);
    if (common.json && count == 1) {
      all = detection_json(detection);
    } else if (common.json) {
      all.push_back({{"cloud", name}});
      all.back().update(detection_json(detection));
    } else {
      const std::string text = format_rows(detection_rows(name, detection), false);
      print_text(text);
      std::fflush(stdout);  // into pipes too, while the next cloud is worked on
      rows += text;
    }
    progress.step();
  }
  if (common.json)
    print_results(common, "detection", ".json", json_text(all));
  else
    keep_results(common, "detection", ".txt", rows);
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
  return [options, &common] {
    if (!options->poses.empty() && (options->clouds.empty() || options->method != "robust"))
      throw UsageError("--poses needs clouds and the method robust");
    if (options->clouds.empty() && !options->live) throw UsageError("needs a CLOUD or --live");
    run_detect(*options, common);
  };
}

}  // namespace fathom
