#include "sim/scene/setup.h"

#include <fmt/format.h>

#include <tuple>

#include "core/error.h"
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

Circumstances circumstances_from_json(const JsonReader& json) {
  json.allow_only({"time_s", "stood_s", "liquid", "liquids"});
  Circumstances circumstances;
  circumstances.time_s = json.number_or("time_s", 0.0, kNonNegative);
  circumstances.stood_s = json.number_or("stood_s", 0.0, kNonNegative);
  circumstances.liquid = json.text_or("liquid", "");
  for (const JsonReader& liquid : json.items_or_none("liquids"))
    circumstances.liquids.push_back(medium_from_json(liquid));
  return circumstances;
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
  root.allow_only({"$schema", "sensor", "desk", "cups", "objects", "effects", "circumstances"});
  Setup setup{.scene = scene_from_json(root), .rig = rig_from_json(root.at("sensor")), .source = json, .file = file};
  for (const JsonReader& effect : root.items_or_none("effects")) setup.effects.push_back(effect.value());
  if (root.has("circumstances")) setup.circumstances = circumstances_from_json(root.at("circumstances"));
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

}  // namespace fathom
