#include "app/measurement_folder.h"

#include <CLI/CLI.hpp>

namespace fathom {

std::shared_ptr<std::filesystem::path> add_measurement_folder(CLI::App& app, bool is_required) {
  auto folder = std::make_shared<std::filesystem::path>();
  app.add_option("folder", *folder, "Measurement directory: rig.json, frames.csv and clouds")
      ->required(is_required)
      ->type_name("DIR");
  return folder;
}

}  // namespace fathom
