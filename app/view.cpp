// `fathom view`: a capture, a detection or a diagnosis as a page that turns.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "core/error.h"
#include "core/folder_owner.h"
#include "core/rows.h"
#include "core/view_page.h"
#include "report/kept_detection.h"
#include "sim/sensor/capture_files.h"
#include "view/page.h"
#include "view/scenes.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  fs::path folder, three = kThreeFolder;
  int frame = 0;
  std::string show;
};

/// Results of which a page can be made. A folder that has `file` holds them.
struct Viewable {
  const char* name;
  const char* file;
  PageContent (*content)(const ViewOptions& options);
};

PageContent diagnosis_content(const ViewOptions& options) {
  if (options.frame > 0)
    throw Error(options.folder.string(), "holds a diagnosis, which has no frames: leave --frame out");
  return {diagnosis_scene(options.folder), kDiagnosisScript};
}

constexpr std::array kViewables{Viewable{"capture", "run.json",
                                         [](const ViewOptions& options) -> PageContent {
                                           return {capture_scene(options.folder, options.frame), kCaptureScript};
                                         }},
                                Viewable{"detection", kDetectionFile,
                                         [](const ViewOptions& options) -> PageContent {
                                           return {detection_scene(options.folder, options.frame), kDetectionScript};
                                         }},
                                Viewable{"diagnosis", "report.json", diagnosis_content}};

/// What of the folder is shown. Throws Error where it holds nothing, or several and none is chosen.
const Viewable& viewable_in(const ViewOptions& options) {
  std::vector<const Viewable*> found;
  std::vector<std::string> names;
  for (const Viewable& one : kViewables) {
    if (options.show == one.name) return one;
    if (!fs::exists(options.folder / one.file)) continue;
    found.push_back(&one);
    names.push_back(one.name);
  }
  if (found.empty())
    throw Error(options.folder.string(),
                "holds no complete capture, detection or diagnosis: it has no run.json, detection.json or report.json");
  if (found.size() > 1)
    throw Error(options.folder.string(),
                fmt::format("holds a {}: choose one with --show", fmt::join(names, " and a ")));
  return *found.front();
}

std::string title_of(const fs::path& folder) {
  return kViewTitle + fs::absolute(folder / "").lexically_normal().parent_path().filename().string();
}

void run_view(const ViewOptions& options, const CommonOptions& common) {
  const PageContent content = viewable_in(options).content(options);
  const std::string page = view_page(title_of(options.folder), content, options.three);
  const fs::path file = common.output.empty() ? options.folder / kViewPage : common.output;
  std::optional<FolderOwner> owner;
  if (common.output.empty()) owner.emplace(options.folder);
  write_text(file, page);
  print_text(
      format_rows({{"page", file.string()}, {"size", static_cast<double>(page.size()) * 1e-6, "MB"}}, common.json));
}

}  // namespace

std::function<void()> define_view(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<ViewOptions>();
  app.add_option("folder", options->folder, "What fathom capture, detect or diagnose wrote")
      ->required()
      ->type_name("DIR");
  std::vector<std::string> names;
  for (const Viewable& one : kViewables) names.emplace_back(one.name);
  app.add_option("--show", options->show, "What of a folder that holds several")
      ->check(one_of("kind", names))
      ->type_name("KIND");
  app.add_option("--frame", options->frame, "Which of a capture's frames, or of a detection's clouds")
      ->check(CLI::Range(0, kMostFrames - 1))
      ->capture_default_str();
  app.add_option("--three-js", options->three, "Folder of three.js")->type_name("DIR")->capture_default_str();
  return [options, &common] { run_view(*options, common); };
}

}  // namespace fathom
