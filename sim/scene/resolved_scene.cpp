#include "sim/scene/resolved_scene.h"

#include <fmt/format.h>

#include <map>

#include "core/files.h"
#include "core/json.h"
#include "core/library.h"
#include "sim/scene/gltf_json.h"

namespace fathom {
namespace {

/// The entry of a library, which knows its name.
Json entry_of(const char* library, const char* kind, const Json& name, const std::string& file) {
  Json entry = {{"name", name}};
  entry.update(read_json(library_file(library, kind, name.get<std::string>(), file, "")));
  entry["name"] = name;
  return entry;
}

class Resolver {
 public:
  explicit Resolver(const Setup& setup) : setup_(setup) {}

  ResolvedScene resolve() {
    Json scene = setup_.source;
    scene.erase("$schema");
    sensor(scene["sensor"]);
    for (const char* list : {"cups", "objects"})
      if (scene.contains(list))
        for (Json& thing : scene[list]) *list == 'c' ? cup(thing) : object(thing);
    if (scene.contains("circumstances") && scene["circumstances"].contains("liquids"))
      for (Json& liquid : scene["circumstances"]["liquids"]) medium(liquid);
    scene["effects"] = setup_.switched_on;
    for (const Json& effect : Json(setup_.effects)) scene["effects"].push_back(effect);
    resolved_.scene = std::move(scene);
    return std::move(resolved_);
  }

 private:
  /// The scene's own keys change the model's; parts are read key by key in both, but for the noise.
  void sensor(Json& sensor) {
    if (sensor.contains("unit") && sensor["unit"].is_string())
      sensor["unit"] = {{"learned", sensor["unit"]}, {"residue_px", 0.0}};
    if (sensor.contains("model")) {
      Json model = entry_of("sensors", "sensor model", sensor["model"], setup_.file);
      model.erase("source");
      if (sensor.contains("depth_size_px")) model.erase("principal_px");  // the image's middle unless it is said
      sensor.erase("model");
      for (const auto& [key, value] : sensor.items()) {
        const bool part = key == "optics" || key == "unit" || key == "pattern" || key == "matcher";
        if (part && model.contains(key))
          model[key].update(value);
        else
          model[key] = value;
      }
      sensor = std::move(model);
    }
    if (const PatternImage& image = setup_.rig.sensor.pattern.image; image.brightness)
      sensor["pattern"]["image"] = copied(image.file);
    if (setup_.rig.sensor.unit.learned.map) sensor["unit"]["learned"] = copied_unit(setup_.rig.sensor.unit.learned);
  }

  void cup(Json& cup) {
    shape(cup["shape"]);
    if (cup.contains("liquid")) medium(cup["liquid"]);
  }

  void shape(Json& shape) {
    if (shape.is_string() && names_gltf(shape.get<std::string>())) {
      shape = copied(beside(shape));
      return;
    }
    if (shape.is_string()) shape = entry_of("cups", "cup shape", shape, setup_.file);
    if (!shape.contains("material")) return;
    Json& material = shape["material"];
    if (material.is_string()) material = entry_of("walls", "wall material", material, setup_.file);
    material.erase("ranges");  // as of liquids
  }

  void medium(Json& medium) {
    if (medium.is_string()) {
      medium = entry_of("media", "liquid", medium, setup_.file);
    } else if (medium.contains("name") && !medium.contains("index")) {
      medium["of"] = entry_of("media", "liquid", medium["name"], setup_.file);
      if (medium.contains("dilution")) medium["in"] = entry_of("media", "liquid", "water", setup_.file);
      medium.erase("name");
    }
    for (const char* part : {"of", "in"})
      if (medium.contains(part)) medium[part].erase("ranges");
    medium.erase("ranges");  // what is believed of the numbers, no part of what is there
  }

  void object(Json& object) {
    if (object.contains("gltf")) {
      object["gltf"] = copied(beside(object["gltf"]));
      return;
    }
    Json& solid = object["solid"];
    if (solid.is_string()) solid = entry_of("solids", "solid", solid, setup_.file);
    if (solid.contains("cup")) shape(solid["cup"]);
  }

  std::filesystem::path beside(const Json& name) const {
    return std::filesystem::path(setup_.file).parent_path() / name.get<std::string>();
  }

  /// The name of a file's copy, which keeps its own in a folder of its own.
  std::string copied(const std::filesystem::path& file) {
    const auto [known, is_new] = copies_.try_emplace(file.string());
    if (!is_new) return known->second;
    const std::string folder = fmt::format("{}/{}/", kSceneFiles, copies_.size() - 1);
    known->second = folder + file.filename().string();
    const NamedFile& copy = resolved_.files.emplace_back(NamedFile{known->second, read_text(file)});
    if (names_gltf(file.string()))
      for (const std::string& buffer : gltf_buffers(file, std::string(copy.content)))
        resolved_.files.push_back({folder + buffer, read_text(file.parent_path() / buffer)});
    return known->second;
  }

  /// The same with the image that it names.
  std::string copied_unit(const LearnedUnit& unit) {
    const std::size_t before = copies_.size();
    const std::string name = copied(unit.file);
    if (copies_.size() > before)
      resolved_.files.push_back({(std::filesystem::path(name).parent_path() / unit.image).string(),
                                 read_text(std::filesystem::path(unit.file).parent_path() / unit.image)});
    return name;
  }

  const Setup& setup_;
  ResolvedScene resolved_;
  std::map<std::string, std::string> copies_;  ///< by the files' paths
};

}  // namespace

ResolvedScene resolved_scene(const Setup& setup) { return Resolver(setup).resolve(); }

}  // namespace fathom
