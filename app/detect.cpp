// fathom detect: cups and their liquids in clouds, as rows or as JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/detection_report.h"
#include "app/detector_options.h"
#include "app/results.h"
#include "core/error.h"
#include "core/progress.h"
#include "detector/read_cloud.h"

namespace fathom {
namespace {

struct DetectOptions {
  std::vector<std::filesystem::path> clouds;
  std::string method{methods().front().name};
  DeskOptions desk;
  std::filesystem::path config;
};

void run_detect(const DetectOptions& options, const CommonOptions& common) {
  const Method& method = method_named(options.method);
  DetectorSettings settings = detector_settings(options.config);
  settings.prior = options.desk.prior();

  Json all = Json::array();
  std::string rows;
  Progress progress("detect", options.clouds.size(), common.quiet || options.clouds.size() == 1);
  for (const std::filesystem::path& path : options.clouds) {
    const Detection detection = method.detect(read_cloud(path), settings);
    if (common.json && options.clouds.size() == 1) {
      all = detection_json(detection);
    } else if (common.json) {
      all.push_back({{"cloud", path.string()}});
      all.back().update(detection_json(detection));
    } else {
      const std::string text = format_rows(detection_rows(path.string(), detection), false);
      fmt::print("{}", text);
      std::fflush(stdout);  // into pipes too, while the next cloud is worked on
      rows += text;
    }
    progress.step();
  }
  if (common.json)
    print_results(common, "detection", ".json", all.dump(2) + "\n");
  else
    keep_results(common, "detection", ".txt", rows);
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
