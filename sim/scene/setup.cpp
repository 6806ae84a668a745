#include "sim/scene/setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>

#include "core/error.h"
#include "core/fields.h"
#include "sim/scene/medium_json.h"

namespace fathom {
namespace {

/// The scene's media must be known at the sensor's wavelength.
void require_indices(const JsonReader& root, const Setup& setup) {
  const std::vector<JsonReader> cups = root.items_or_none("cups");
  for (std::size_t i = 0; i < cups.size(); ++i)
    if (const auto& filling = setup.scene.cups[i].filling)
      require_index(cups[i].at("liquid"), filling->medium, setup.rig.sensor.wavelength_nm);
}

void require_files(const JsonReader& root, const Scene& scene) {
  const std::vector<JsonReader> objects = root.items_or_none("objects");
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (const auto* gltf = std::get_if<std::filesystem::path>(&scene.objects[i].thing);
        gltf && !std::filesystem::is_regular_file(*gltf))
      objects[i].fail_at("gltf", fmt::format("there is no file {}", gltf->string()));
}

std::span<const Field<Circumstances>> circumstance_fields() {
  using Facts = Circumstances;
  static const Field<Facts> fields[] = {
      {"time_s", &Facts::time_s, kNonNegative, "since the session began, at frame 0"},
      {"stood_s", &Facts::stood_s, kNonNegative, "how long the cups have been filled by then"},
      {"liquid", &Facts::liquid, "as labelled, where that is not the liquid's name"},
      {"liquids",
       Part<Facts>{
           [](const JsonReader& json, Facts& facts) {
             for (const JsonReader& liquid : json.items()) facts.liquids.push_back(medium_from_json(liquid));
           },
           nullptr,
           R"({"type": "array", "items": {"anyOf": [{"type": "string"}, {"$ref": "#/$defs/liquid"}, {"$ref": "#/$defs/changed_liquid"}]}})",
           "a list"},
       "all that are poured, in the order of their labels"}};
  return fields;
}

std::span<const Field<Setup>> setup_fields() {
  static const Field<Setup> fields[] = {
      schema_field<Setup>(),
      {"sensor",
       Part<Setup>{[](const JsonReader& json, Setup& setup) { setup.rig = rig_from_json(json); }, nullptr,
                   "#/$defs/sensor", "an object"},
       "the device, and where it stands", true},
      {"desk", unread<Setup>(R"({"anyOf": [{"$ref": "#/$defs/desk"}, {"type": "null"}]})", "an object or null"),
       "null: no desk"},
      {"cups", unread<Setup>(R"({"type": "array", "items": {"$ref": "#/$defs/cup"}})", "a list of objects"),
       "cups, and what is in them"},
      {"objects", unread<Setup>(R"({"type": "array", "items": {"$ref": "#/$defs/object"}})", "a list of objects"),
       "what else stands about"},
      {"effects",
       Part<Setup>{[](const JsonReader& json, Setup& setup) { json.items(), setup.effects = json.value(); }, nullptr,
                   R"({"type": "array", "items": {"$ref": "#/$defs/effect"}})", "a list of objects"},
       "what the scene has beside the above: names and parameters by `fathom list effects`"},
      {"circumstances",
       Part<Setup>{
           [](const JsonReader& json, Setup& setup) { read_fields(json, circumstance_fields(), setup.circumstances); },
           nullptr, "#/$defs/circumstances", "an object"},
       "when it is shot, and of what as far as the laboratory knows; for the effects that go by it"}};
  return fields;
}

/// All that decides what is shot: a new member of Setup does not compile until it is here or left out.
auto what_is_shot(const Setup& setup) {
  const auto& [scene, rig, source, file, effects, switched_on, circumstances, processing, light] = setup;
  return std::tie(scene, rig, effects, circumstances, processing, light);
}

}  // namespace

bool Setup::operator==(const Setup& other) const { return what_is_shot(*this) == what_is_shot(other); }

Json json_from_processing(const Processing& processing) {
  const auto& [window_px, colour_view, bisector] = processing;
  return {{"window_px", window_px}, {"colour_view", colour_view}, {"bisector_share", bisector}};
}

Json json_from_light(const IndirectLight& light) {
  const auto& [interreflected, mirrored] = light;
  return {{"interreflected", interreflected}, {"mirrored", mirrored}};
}

void require_index(const JsonReader& json, const Medium& medium, double wavelength_nm) {
  if (wavelength_nm < medium.wavelength_min_nm || wavelength_nm > medium.wavelength_max_nm)
    json.fail(fmt::format("the index of {} is known from {} to {} nm, the sensor works at {} nm", medium.name,
                          medium.wavelength_min_nm, medium.wavelength_max_nm, wavelength_nm));
}

Setup setup_from_json(const Json& json, const std::string& file, const std::string& pointer) {
  const JsonReader root(json, file, pointer);
  Setup setup{.scene = {}, .rig = {}, .source = json, .file = file};
  read_fields(root, setup_fields(), setup);
  setup.scene = scene_from_json(root);
  require_indices(root, setup);
  return setup;
}

Setup read_setup(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".gltf" || extension == ".glb")
    throw Error(path.string(),
                "glTF scenes cannot be read yet; write a scene file (*.json) that names it under \"objects\"");
  return whole_setup_from_json(read_json(path), path.string());
}

Setup whole_setup_from_json(const Json& json, const std::string& file) {
  Setup setup = setup_from_json(json, file);
  require_files(JsonReader(setup.source, file), setup.scene);
  return setup;
}

std::vector<KeyTable> setup_key_tables() {
  std::vector<KeyTable> tables{
      {"", "", "Scene", key_rows(setup_fields(), Setup{})},
      {"circumstances", "circumstances", "Circumstances", key_rows(circumstance_fields(), Circumstances{})}};
  std::ranges::move(scene_key_tables(), std::back_inserter(tables));
  return tables;
}

}  // namespace fathom
