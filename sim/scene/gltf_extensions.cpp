#include "sim/scene/gltf_extensions.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/json.h"

namespace fathom {

void require_known_extensions(std::string_view json, const std::string& file) {
  static const std::vector<std::string> kKnown{"KHR_materials_ior", "KHR_materials_transmission",
                                               "KHR_materials_volume"};
  const Json gltf = Json::parse(json, nullptr, false);
  if (!gltf.is_object() || !gltf.contains("extensionsRequired")) return;
  const Json& required = gltf["extensionsRequired"];
  for (std::size_t i = 0; required.is_array() && i < required.size(); ++i) {
    const std::string name = required[i].is_string() ? required[i].get<std::string>()
                                                     : required[i].dump(-1, ' ', false, Json::error_handler_t::replace);
    if (std::find(kKnown.begin(), kKnown.end(), name) == kKnown.end())
      throw Error(file, "/extensionsRequired", unknown_name("extension", name, kKnown));
  }
}

}  // namespace fathom
