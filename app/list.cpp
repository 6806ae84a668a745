// `fathom list`: the libraries that come with the program.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/commands.h"
#include "core/files.h"
#include "core/json.h"
#include "core/units.h"
#include "sim/scene/library.h"
#include "sim/scene/scene.h"

namespace fathom {
namespace {

void run(const std::string& library, bool as_json) {
  Json entries = Json::object();
  for (const std::string& name : library_names(library)) {
    entries[name] = read_json(data_directory() / library / (name + ".json"));
    if (library != "cups") continue;
    const Json as_shape = name;
    const CupShape shape = cup_shape_from_json(JsonReader(as_shape, "list"));
    entries[name]["capacity_ml"] = ml_from_cubic_metres(shape.volume(shape.height() - shape.bottom()));
  }
  if (as_json) {
    fmt::print("{}\n", entries.dump(2));
    return;
  }
  for (const auto& [name, entry] : entries.items()) {
    fmt::print("{}\n", name);
    for (const auto& [key, value] : entry.items())
      fmt::print("  {:<22} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
}

}  // namespace

std::function<void()> define_list(CLI::App& app, const CommonOptions& common) {
  const auto library = std::make_shared<std::string>();
  app.add_option("library", *library, "media, cups or sensors")
      ->required()
      ->check(CLI::IsMember({"media", "cups", "sensors"}));
  return [library, &common] { run(*library, common.json); };
}

}  // namespace fathom
