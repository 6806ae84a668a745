// `fathom export`: a scene as glTF, for programs that draw.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/print.h"
#include "core/error.h"
#include "core/files.h"
#include "core/rows.h"
#include "sim/effects/effects_json.h"
#include "sim/scene/gltf_export.h"

namespace fathom {
namespace {

struct ExportOptions {
  std::filesystem::path scene;
  std::optional<int> cup;
};

std::string glb_of(const Setup& setup, const ExportOptions& options) {
  if (!options.cup) return glb_of_scene(setup);
  const std::size_t cups = setup.scene.cups.size();
  if (static_cast<std::size_t>(*options.cup) >= cups)
    throw Error(options.scene.string(),
                fmt::format("has {} cup{}, so there is none of number {}", cups, cups == 1 ? "" : "s", *options.cup));
  return glb_of_cup(setup.scene.cups[static_cast<std::size_t>(*options.cup)], setup.rig.sensor.wavelength_nm);
}

void run_export(const ExportOptions& options, const CommonOptions& common) {
  const std::string bytes = glb_of(with_effects(read_setup(options.scene)), options);
  write_text(common.output, bytes);
  print_text(format_rows({{"file", common.output.string()}, {"size", static_cast<double>(bytes.size()) * 1e-6, "MB"}},
                         common.json));
}

}  // namespace

std::function<void()> define_export(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<ExportOptions>();
  app.add_option("scene", options->scene, "Scene file (*.json)")->required()->type_name("SCENE");
  app.add_option("--cup", options->cup, "Only the cup of that number, from 0, empty: a shape for another scene")
      ->check(CLI::Range(0, 1'000'000));
  return [options, &common] {
    if (common.output.extension() != ".glb")
      throw UsageError("-o must name a .glb file, got " + common.output.string());
    run_export(*options, common);
  };
}

}  // namespace fathom
