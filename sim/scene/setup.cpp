#include "sim/scene/setup.h"

#include "core/error.h"

namespace fathom {

Setup setup_from_json(const Json& json, const std::string& file) {
  const JsonReader root(json, file);
  root.allow_only({"$schema", "sensor", "desk", "cups", "objects", "effects"});
  if (!root.items_or_none("effects").empty())
    root.fail_at("effects", "names an effect, but this version has none to switch on; leave the list empty");
  return {scene_from_json(root), rig_from_json(root.at("sensor")), json};
}

Setup read_setup(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".gltf" || extension == ".glb")
    throw Error(path.string(),
                "glTF scenes cannot be read yet; write a scene file (*.json) that names it under \"objects\"");
  return setup_from_json(read_json(path), path.string());
}

}  // namespace fathom
