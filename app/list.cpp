// `fathom list`: the libraries that come with the program, and the keys of the files that people write.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/options.h"
#include "app/results.h"
#include "campaign/campaign_spec.h"
#include "core/files.h"
#include "core/json.h"
#include "core/key_table.h"
#include "core/library.h"
#include "core/units.h"
#include "datasets/dataset_spec.h"
#include "detector/settings_json.h"
#include "diagnosis/measurement/laboratory_rig.h"
#include "sim/effects/registry.h"
#include "sim/scene/clutter.h"
#include "sim/scene/scene.h"
#include "sim/scene/setup.h"

namespace fathom {
namespace {

std::string lines_of(const Effect& effect) {
  std::string text =
      fmt::format("{}\n  {:<22} {}\n  {:<22} {}\n", effect.id, "family", effect.family, "sentence", effect.sentence);
  for (const EffectParameter& p : effect.parameters)
    text += fmt::format("  {:<22} {}: {}; absent at {:g}, typically off by {:g}, from {:g} to {:g}\n", "parameter",
                        p.name, p.meaning, p.nominal, p.scale, p.lower, p.upper);
  if (effect.of_liquids) text += fmt::format("  {:<22} {}\n", "liquid", "may be limited to one liquid by its label");
  text += fmt::format("  {:<22} {}\n", "citation", effect.citation);
  text += fmt::format("  {:<22} {}\n", "confounded", fmt::join(effect.confounded, ", "));
  return text + fmt::format("  {:<22} {}\n", "discriminated_by", effect.discriminated_by);
}

Json json_of(const Effect& effect) {
  Json parameters = Json::array();
  for (const EffectParameter& p : effect.parameters)
    parameters.push_back({{"name", p.name},
                          {"meaning", p.meaning},
                          {"nominal", p.nominal},
                          {"prior_scale", p.scale},
                          {"lower", p.lower},
                          {"upper", p.upper},
                          {"inverse", p.inverse}});
  return {{"name", effect.id},
          {"family", effect.family},
          {"sentence", effect.sentence},
          {"parameters", parameters},
          {"of_liquids", effect.of_liquids},
          {"citation", effect.citation},
          {"confounded", effect.confounded},
          {"discriminated_by", effect.discriminated_by}};
}

/// The effects that `effects` of a scene or a model can switch on.
std::string effects_text(bool as_json) {
  Json list = Json::array();
  std::string text;
  for (const Effect& effect : effect_registry()) {
    list.push_back(json_of(effect));
    text += lines_of(effect);
  }
  return as_json ? json_text(list) : text;
}

struct FileKeys {
  const char* file;  ///< what people call it
  std::vector<KeyTable> (*tables)();
};
constexpr FileKeys kFiles[] = {
    {"scene", setup_key_tables},      {"campaign", campaign_key_tables},    {"rig", rig_key_tables},
    {"data set", dataset_key_tables}, {"random desks", clutter_key_tables}, {"detector", detector_key_tables},
    {"template", template_key_tables}};

/// The keys of the files that people write: what they mean, what is allowed, and what holds without them.
std::string keys_text(bool as_json) {
  Json list = Json::array();
  std::string text;
  for (const FileKeys& file : kFiles)
    for (const KeyTable& table : file.tables()) {
      Json keys = Json::array();
      text += fmt::format("{}{}{}\n", file.file, table.place.empty() ? "" : ": ", table.place);
      for (const KeyRow& row : table.rows) {
        keys.push_back({{"key", row.key},
                        {"meaning", row.meaning},
                        {"allowed", row.allowed},
                        {"required", row.is_required},
                        {"default", row.standard},
                        {"schema", row.schema}});
        const bool shows = row.is_required || !(row.standard.is_null() || row.standard.is_object());
        text += fmt::format("  {:<22} {}; {}{}\n", row.key, row.meaning, row.allowed,
                            !shows            ? ""
                            : row.is_required ? "; required"
                                              : "; default " + row.standard.dump());
      }
      list.push_back({{"file", file.file},
                      {"place", table.place},
                      {"definition", table.definition},
                      {"title", table.title},
                      {"keys", keys}});
    }
  return as_json ? json_text(list) : text;
}

/// {"n": 1.336, "at_nm": 830} as "n 1.336, at_nm 830"; anything else as it stands.
std::string shown(const Json& value) {
  if (!value.is_object()) return value.dump();
  std::string text;
  for (const auto& [key, part] : value.items())
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", key, part.is_string() ? part.get<std::string>() : part.dump());
  return text;
}

std::string library_text(const std::string& library, bool as_json) {
  Json entries = Json::object();
  for (const std::string& name : library_names(library)) {
    entries[name] = read_json(data_directory() / library / (name + ".json"));
    if (library != "cups") continue;
    const Json as_shape = name;
    const CupShape shape = cup_shape_from_json(JsonReader(as_shape, "list"));
    entries[name]["capacity_ml"] = ml_from_cubic_metres(shape.volume(shape.height() - shape.bottom()));
  }
  if (as_json) return json_text(entries);
  std::string text;
  for (const auto& [name, entry] : entries.items()) {
    text += name + "\n";
    for (const auto& [key, value] : entry.items())
      text += fmt::format("  {:<22} {}\n", key, value.is_string() ? value.get<std::string>() : shown(value));
  }
  return text;
}

}  // namespace

std::function<void()> define_list(CLI::App& app, const CommonOptions& common) {
  const auto library = std::make_shared<std::string>();
  app.add_option("library", *library, "media, walls, cups, solids, sensors, effects, or the keys of files")
      ->required()
      ->check(one_of("library", {"media", "walls", "cups", "solids", "sensors", "effects", "keys"}));
  return [library, &common] {
    const std::string text = *library == "effects" ? effects_text(common.json)
                             : *library == "keys"  ? keys_text(common.json)
                                                   : library_text(*library, common.json);
    print_results(common, *library, ".txt", text);
  };
}

}  // namespace fathom
