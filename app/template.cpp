// fathom template: makes a cup template from a captured cloud with one empty cup in it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "core/folder_owner.h"
#include "core/json.h"
#include "core/rows.h"
#include "core/units.h"
#include "detector/make_template.h"
#include "detector/read_cloud.h"

namespace fathom {
namespace {

struct TemplateOptions {
  std::filesystem::path cloud;
  std::string name;
  DeskOptions desk;
  std::optional<double> liquid_threshold_mm;
};

/// A simulated cloud has the record of its capture beside it, or above its frame's folder.
void require_empty_cups(const std::filesystem::path& cloud) {
  const std::filesystem::path folder = std::filesystem::absolute(cloud).parent_path();
  for (const std::filesystem::path& record : {folder / "run.json", folder.parent_path() / "run.json"}) {
    if (!std::filesystem::is_regular_file(record)) continue;
    const Json json = read_json(record);
    const JsonReader reader(json, record.string());
    if (!reader.has("scene")) return;
    for (const JsonReader& cup : reader.at("scene").items_or_none("cups"))
      if (cup.number_or("fill_mm", 0.0) > 0.0 || cup.number_or("fill_ml", 0.0) > 0.0)
        cup.fail_at("liquid",
                    fmt::format("the cup of {} holds a liquid, a template needs an empty one", cloud.string()));
    return;
  }
}

void run_template(const TemplateOptions& options, const CommonOptions& common) {
  require_empty_cups(options.cloud);
  std::optional<double> threshold_m;
  if (options.liquid_threshold_mm) threshold_m = metres_from_mm(*options.liquid_threshold_mm);
  const CupTemplate cup = template_of_only_cup(options.name, read_cloud(options.cloud), options.desk.prior(),
                                               threshold_m, options.cloud.string());
  const FolderOwner owner(common.output);
  save_template(common.output, cup);
  print_text(format_rows({{"radius", mm_from_metres(cup.radius_m), "mm"},
                          {"height", mm_from_metres(cup.height_m), "mm"},
                          {"liquid_threshold", mm_from_metres(cup.liquid_threshold_m), "mm"},
                          {"points", static_cast<double>(cup.points.size()), ""}},
                         common.json));
}

}  // namespace

std::function<void()> define_template(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<TemplateOptions>();
  app.add_option("cloud", options->cloud, "PCD or PLY cloud with one empty cup on the desk")
      ->required()
      ->type_name("CLOUD");
  app.add_option("--name", options->name, "Name of the template and its files")
      ->required()
      ->check([](const std::string& name) {
        const bool plain = !name.empty() && name.find_first_not_of(
                                                "abcdefghijklmnopqrstuvwxyz"
                                                "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
        return plain ? std::string() : "a name is made of letters, digits, _ and -";
      });
  add_desk_options(app, options->desk);
  app.add_option("--liquid-threshold-mm", options->liquid_threshold_mm,
                 "A mean height inside above this is a liquid; default: 2 mm above the bottom that is seen")
      ->check(number_within(kPositive))
      ->type_name("MM");
  return [options, &common] { run_template(*options, common); };
}

}  // namespace fathom
