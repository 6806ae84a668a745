// `fathom view`: a capture as a page that turns.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/print.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/rows.h"
#include "sim/sensor/capture_files.h"
#include "view/capture_scene.h"
#include "view/page.h"

namespace fathom {
namespace {

struct ViewOptions {
  std::filesystem::path folder, three = kThreeFolder;
  int frame = 0;
};

std::string title_of(const std::filesystem::path& folder) {
  return fmt::format("Fathom: view of {}",
                     std::filesystem::absolute(folder / "").lexically_normal().parent_path().filename().string());
}

void run_view(const ViewOptions& options, const CommonOptions& common) {
  const Json scene = capture_scene(options.folder, options.frame);
  const std::string page = view_page(title_of(options.folder), scene, options.three);
  const std::filesystem::path file = common.output.empty() ? options.folder / kViewPage : common.output;
  std::optional<FolderOwner> owner;
  if (common.output.empty()) owner.emplace(options.folder);
  write_text(file, page);
  print_text(
      format_rows({{"page", file.string()}, {"size", static_cast<double>(page.size()) * 1e-6, "MB"}}, common.json));
}

}  // namespace

std::function<void()> define_view(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<ViewOptions>();
  app.add_option("folder", options->folder, "What fathom capture wrote")->required()->type_name("DIR");
  app.add_option("--frame", options->frame, "Which of its frames")
      ->check(CLI::Range(0, kMostFrames - 1))
      ->capture_default_str();
  app.add_option("--three-js", options->three, "Folder of three.js")->type_name("DIR")->capture_default_str();
  return [options, &common] { run_view(*options, common); };
}

}  // namespace fathom
