#include "sim/scene/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <set>

#include "core/error.h"
#include "core/json.h"

namespace fathom {
namespace {

/// "%20" is a blank.
std::string decoded(const std::string& uri) {
  const auto hexadecimal = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hexadecimal(uri[i + 1]) && hexadecimal(uri[i + 2])) {
      text += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

}  // namespace

std::string_view gltf_json(std::string_view content, bool binary) {
  if (!binary) return content;
  constexpr std::size_t kHeader = 20, kLength = 12;  // "glTF", version, length, the chunk's length, "JSON"
  if (content.size() < kHeader) return {};
  std::uint32_t length = 0;
  std::memcpy(&length, content.data() + kLength, sizeof length);
  return content.substr(kHeader, length);
}

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

std::vector<std::string> gltf_buffers(const std::filesystem::path& gltf, const std::string& content) {
  const Json json = Json::parse(gltf_json(content, content.starts_with("glTF")), nullptr, false);
  std::vector<std::string> names;
  std::set<std::string> known;  // a file that thousands of buffers name is copied once
  if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) return names;
  for (std::size_t i = 0; i < json["buffers"].size(); ++i) {
    const Json& buffer = json["buffers"][i];
    const std::string uri = buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string()
                                ? buffer["uri"].get<std::string>()
                                : std::string();
    if (uri.empty() || uri.starts_with("data:")) continue;
    const std::filesystem::path name = decoded(uri);
    if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end())
      throw Error(gltf.string(), fmt::format("/buffers/{}/uri", i),
                  "lies outside the file's folder; a capture keeps copies of what is below it only");
    if (known.insert(name.string()).second) names.push_back(name.string());
  }
  return names;
}

}  // namespace fathom
