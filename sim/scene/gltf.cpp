#include "sim/scene/gltf.h"

#define TINYGLTF_IMPLEMENTATION
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "core/error.h"
#include "core/files.h"
#include "core/input_policy.h"
#include "core/modest_json.h"
#include "core/range.h"
#include "core/units.h"
#include "sim/scene/gltf_json.h"

namespace fathom {
namespace {

/// A model with its file's name, so that every error can say where it is.
struct Reader {
  std::string file;
  tinygltf::Model model;
  int placed_meshes = 0;                         ///< so far, by nodes
  std::vector<bool> placed_nodes;                ///< so far, by index
  std::uint64_t claimed = 0;                     ///< [bytes] by the triangles so far
  std::map<std::array<int, 3>, GltfPart> parts;  ///< by material, clear body, whether it has normals

  [[noreturn]] void fail(const std::string& where, const std::string& what) const { throw Error(file, where, what); }

  /// First byte, stride and count of an accessor, after its range has been checked against the buffer.
  struct Bytes {
    const unsigned char* data;
    std::size_t stride, count;
    int component;
  };
  Bytes bytes(int index, int type, const std::string& where) const {
    if (index < 0 || index >= static_cast<int>(model.accessors.size()))
      fail(where, "names an accessor that does not exist");
    const tinygltf::Accessor& accessor = model.accessors[index];
    if (accessor.type != type || accessor.sparse.isSparse)
      fail(where, "has an accessor of a kind that is not supported");
    if (accessor.bufferView < 0 || accessor.bufferView >= static_cast<int>(model.bufferViews.size()))
      fail(where, "has an accessor without a buffer view");
    const tinygltf::BufferView& view = model.bufferViews[accessor.bufferView];
    if (view.buffer < 0 || view.buffer >= static_cast<int>(model.buffers.size()))
      fail(where, "names a buffer that does not exist");
    const std::vector<unsigned char>& buffer = model.buffers[view.buffer].data;
    const int stride = accessor.ByteStride(view);
    const std::size_t element = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(accessor.componentType) *
                                                         tinygltf::GetNumComponentsInType(type));
    const std::size_t first = view.byteOffset + accessor.byteOffset;
    if (stride <= 0 || accessor.count == 0 || first > buffer.size() || element > buffer.size() - first ||
        (accessor.count - 1) > (buffer.size() - first - element) / static_cast<std::size_t>(stride))
      fail(where, "reaches past the end of its buffer");
    return {buffer.data() + first, static_cast<std::size_t>(stride), accessor.count, accessor.componentType};
  }

  std::vector<int> indices(const tinygltf::Primitive& primitive, std::size_t vertices, const std::string& where) const {
    std::vector<int> result;
    if (primitive.indices < 0) {
      for (std::size_t i = 0; i < vertices; ++i) result.push_back(static_cast<int>(i));
    } else {
      const Bytes source = bytes(primitive.indices, TINYGLTF_TYPE_SCALAR, where);
      for (std::size_t i = 0; i < source.count; ++i) {
        const unsigned char* at = source.data + i * source.stride;
        std::uint32_t index = 0;
        switch (source.component) {
          case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            index = *at;
            break;
          case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
            std::uint16_t value;
            std::memcpy(&value, at, 2);
            index = value;
            break;
          }
          case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            std::memcpy(&index, at, 4);
            break;
          default:
            fail(where, "has indices that are not unsigned integers");
        }
        if (index >= vertices) fail(where, fmt::format("has the index {}, but only {} vertices", index, vertices));
        result.push_back(static_cast<int>(index));
      }
    }
    if (result.size() % 3 != 0) fail(where, "has a number of indices that is no multiple of 3");
    return result;
  }

  /// Each placing of a mesh takes its memory anew.
  void claim_memory(const tinygltf::Primitive& primitive, std::size_t vertices, const std::string& where) {
    const std::size_t corners =
        primitive.indices < 0 ? vertices : bytes(primitive.indices, TINYGLTF_TYPE_SCALAR, where).count;
    claimed += traced_bytes(vertices, corners / 3);
    require_within_limit(file, where, claimed, "triangles");
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Eigen::Matrix4d& scene_from_node,
                     const std::string& where) {
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1)
      fail(where, "is no list of triangles, the only kind supported");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) fail(where, "has no POSITION");
    const Bytes source = bytes(position->second, TINYGLTF_TYPE_VEC3, where);
    if (source.component != TINYGLTF_COMPONENT_TYPE_FLOAT) fail(where, "has positions that are not floats");
    claim_memory(primitive, source.count, where);
    Mesh mesh;
    for (const Eigen::Vector3f& value : vectors(source)) {
      const Eigen::Vector3d in_scene = (scene_from_node * value.cast<double>().homogeneous()).head<3>();
      if (!in_scene.allFinite()) fail(where, "has a position that is not finite");
      if (in_scene.cwiseAbs().maxCoeff() > metres_from_mm(kPlaceMm.high))
        fail(where,
             fmt::format("has a position beyond {:g} m; lengths in glTF are metres", metres_from_mm(kPlaceMm.high)));
      mesh.add_vertex(z_up(in_scene));
    }
    const Eigen::Matrix3d linear = scene_from_node.topLeftCorner<3, 3>();
    const bool mirrored = linear.determinant() < 0.0;  // which turns the triangles inside out
    const std::vector<int> corners = indices(primitive, source.count, where);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      mesh.add_triangle(corners[i], corners[i + (mirrored ? 2 : 1)], corners[i + (mirrored ? 1 : 2)]);

    const std::optional<Medium> medium = clear_medium(primitive.material);
    const std::optional<Coat> coat = medium ? std::nullopt : coat_of(primitive.material);
    std::vector<Eigen::Vector3d> normals;
    if ((medium || coat) && primitive.attributes.contains("NORMAL"))
      normals = scene_normals(primitive, linear, source.count, where);
    GltfPart& part = parts[{primitive.material, medium ? placed_meshes : 0, !normals.empty()}];
    part.mesh.append(mesh);
    part.normals.insert(part.normals.end(), normals.begin(), normals.end());
    part.albedo = albedo(primitive.material);
    part.medium = medium;
    part.coat = coat;
    part.body = medium ? (placed_meshes << 16) + primitive.material : 0;
  }

  static Eigen::Vector3d z_up(const Eigen::Vector3d& y_up) { return {y_up.x(), -y_up.z(), y_up.y()}; }

  static std::vector<Eigen::Vector3f> vectors(const Bytes& source) {
    std::vector<Eigen::Vector3f> result(source.count);
    for (std::size_t i = 0; i < source.count; ++i)
      std::memcpy(result[i].data(), source.data + i * source.stride, sizeof(float) * 3);
    return result;
  }

  std::vector<Eigen::Vector3d> scene_normals(const tinygltf::Primitive& primitive, const Eigen::Matrix3d& linear,
                                             std::size_t vertices, const std::string& where) const {
    const Bytes source = bytes(primitive.attributes.at("NORMAL"), TINYGLTF_TYPE_VEC3, where);
    if (source.component != TINYGLTF_COMPONENT_TYPE_FLOAT) fail(where, "has normals that are not floats");
    if (source.count != vertices) fail(where, "has another number of normals than of positions");
    const Eigen::Matrix3d normals_to_scene = linear.inverse().transpose();
    std::vector<Eigen::Vector3d> result;
    for (const Eigen::Vector3f& value : vectors(source)) {
      const Eigen::Vector3d normal = normals_to_scene * value.cast<double>();
      if (!normal.allFinite() || normal.norm() == 0.0) fail(where, "has a normal that is no direction");
      result.push_back(z_up(normal.normalized()));
    }
    return result;
  }

  static Eigen::Matrix4d local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (node.translation.size() == 3)
      transform.translate(Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(node.translation.data())));
    if (node.rotation.size() == 4)
      transform.rotate(
          Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]).normalized());
    if (node.scale.size() == 3) transform.scale(Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(node.scale.data())));
    return transform.matrix();
  }

  void add_node(int index, const Eigen::Matrix4d& scene_from_parent, int depth) {
    const std::string where = fmt::format("/nodes/{}", index);
    if (index < 0 || index >= static_cast<int>(model.nodes.size())) fail(where, "does not exist");
    if (depth > 100) fail(where, "is nested more than 100 deep");
    if (placed_nodes[index]) fail(where, "stands in the scene twice, must have one parent at most");
    placed_nodes[index] = true;
    const tinygltf::Node& node = model.nodes[index];
    const Eigen::Matrix4d scene_from_node = scene_from_parent * local_transform(node);
    if (node.mesh >= static_cast<int>(model.meshes.size())) fail(where, "names a mesh that does not exist");
    if (node.mesh >= 0) {
      ++placed_meshes;
      const auto& primitives = model.meshes[node.mesh].primitives;
      for (std::size_t i = 0; i < primitives.size(); ++i)
        add_primitive(primitives[i], scene_from_node, fmt::format("/meshes/{}/primitives/{}", node.mesh, i));
    }
    for (const int child : node.children) add_node(child, scene_from_node, depth + 1);
  }

  const tinygltf::Material& material_at(int material) const {
    if (material >= static_cast<int>(model.materials.size()))
      fail(fmt::format("/materials/{}", material), "does not exist");
    return model.materials[material];
  }

  static double luminance(const std::vector<double>& colour) {
    return std::clamp(0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2], 0.0, 1.0);
  }

  double albedo(int material) const {
    if (material < 0) return 0.5;
    const std::vector<double>& colour = material_at(material).pbrMetallicRoughness.baseColorFactor;
    if (colour.size() != 4) fail(fmt::format("/materials/{}", material), "has a base colour that is not 4 numbers");
    return luminance(colour);
  }

  /// Extension `name` of a material, a null value where it has none.
  static tinygltf::Value extension_of(const tinygltf::Material& material, const char* name) {
    const auto found = material.extensions.find(name);
    return found == material.extensions.end() ? tinygltf::Value() : found->second;
  }

  double index_of(int material) const {
    return number_or(extension_of(material_at(material), "KHR_materials_ior"),
                     fmt::format("/materials/{}/extensions/KHR_materials_ior", material), "ior", 1.5, 1.0, 4.0);
  }

  std::optional<Coat> coat_of(int material) const {
    if (material < 0) return std::nullopt;
    const tinygltf::PbrMetallicRoughness& look = material_at(material).pbrMetallicRoughness;
    const double roughness = look.roughnessFactor;
    if (!(roughness >= 0.0 && roughness <= 1.0))
      fail(fmt::format("/materials/{}/pbrMetallicRoughness/roughnessFactor", material), "must be a number from 0 to 1");
    if (look.metallicFactor != 0.0 || roughness == 1.0) return std::nullopt;
    return Coat{std::max(roughness * roughness, kLeastRoughness), index_of(material)};
  }

  /// A number of an extension or of extras, or `otherwise`.
  double number_or(const tinygltf::Value& object, const std::string& where, const char* key, double otherwise,
                   double low, double high) const {
    if (!object.IsObject() || !object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : std::numeric_limits<double>::quiet_NaN();
    if (!(number >= low && number <= high))
      fail(fmt::format("{}/{}", where, key), fmt::format("must be a number from {:g} to {:g}", low, high));
    return number;
  }

  /// The medium of a transmissive material, nothing for an opaque one.
  std::optional<Medium> clear_medium(int material) const {
    if (material < 0) return std::nullopt;
    const tinygltf::Material& source = material_at(material);
    const std::string where = fmt::format("/materials/{}", material), extensions = where + "/extensions/";
    if (number_or(extension_of(source, "KHR_materials_transmission"), extensions + "KHR_materials_transmission",
                  "transmissionFactor", 0.0, 0.0, 1.0) == 0.0)
      return std::nullopt;
    Medium medium;
    medium.name = source.name.empty() ? "clear body" : source.name;
    medium.index = ConstantIndex{index_of(material)};
    constexpr double kMost = 1e9;
    const std::string extras = where + "/extras";
    medium.absorption = per_metre_from_per_mm(
        number_or(source.extras, extras, "absorption_per_mm",
                  volume_absorption(extension_of(source, "KHR_materials_volume"), extensions + "KHR_materials_volume") *
                      kMetresPerMm,
                  0.0, kMost));
    medium.scattering = per_metre_from_per_mm(number_or(source.extras, extras, "scattering_per_mm", 0.0, 0.0, kMost));
    medium.anisotropy = number_or(source.extras, extras, "anisotropy", 0.0, -0.999, 0.999);
    return medium;
  }

  /// μa [1/m] by which attenuationColor is left of white after attenuationDistance; of its luminance, since nothing is
  /// said of the infrared.
  double volume_absorption(const tinygltf::Value& volume, const std::string& where) const {
    const double distance = number_or(volume, where, "attenuationDistance", 0.0, 1e-9, 1e9);
    if (distance == 0.0 || !volume.Has("attenuationColor")) return 0.0;
    const tinygltf::Value& colour = volume.Get("attenuationColor");
    std::vector<double> values;
    for (std::size_t i = 0; i < colour.ArrayLen(); ++i)
      values.push_back(colour.Get(static_cast<int>(i)).GetNumberAsDouble());
    if (values.size() != 3 || !(luminance(values) > 0.0))
      fail(where + "/attenuationColor", "must be 3 numbers from 0 to 1, not all 0");
    return -std::log(luminance(values)) / distance;
  }
};

/// How tinygltf comes by the files that buffers name.
struct Buffers {
  std::string file;  ///< that names them
  std::uint64_t bytes = 0;
  std::string problem;  ///< an error's whole line

  tinygltf::FsCallbacks callbacks() { return {exists, as_it_is, read, nullptr, this}; }

 private:
  // tinygltf would also look in the working directory; the only place is said to hold every file.
  static bool exists(const std::string&, void*) { return true; }
  static std::string as_it_is(const std::string& name, void*) { return name; }
  static bool read(std::vector<unsigned char>* to, std::string*, const std::string& name, void* self) {
    auto& buffers = *static_cast<Buffers*>(self);
    try {
      const std::filesystem::path path = path_named_in(buffers.file, "/buffers", name);
      if (std::error_code missing; !std::filesystem::exists(path, missing))
        throw Error(buffers.file, "/buffers", fmt::format("there is no file {}", path.string()));
      const std::string content = read_text(path);
      buffers.bytes += content.size();
      require_within_limit(buffers.file, "/buffers", buffers.bytes, "buffers");
      to->assign(content.begin(), content.end());
      return true;
    } catch (const Error& problem) {
      buffers.problem = problem.what();
      return false;
    }
  }
};

void load(const std::filesystem::path& path, tinygltf::Model& model) {
  // Of tinygltf's materials, the largest of what an empty {} becomes. It keeps its JSON beside what it makes of it.
  constexpr JsonMemory kMemory{.per_value = 1000, .per_byte = 6};
  const std::string content = read_text(path), file = path.string();
  const bool binary = path.extension() == ".glb";
  const std::string_view text = gltf_json(content, binary);
  require_modest_json(text, file, kMemory);
  require_known_extensions(text, file);
  if (content.size() > std::numeric_limits<unsigned int>::max()) throw Error(file, "is larger than 4 GB");
  const auto size = static_cast<unsigned int>(content.size());
  Buffers buffers{.file = file, .problem = {}};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(buffers.callbacks());
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  std::string problem, warning;
  const bool loaded =
      binary ? loader.LoadBinaryFromMemory(&model, &problem, &warning,
                                           reinterpret_cast<const unsigned char*>(content.data()), size, "")
             : loader.LoadASCIIFromString(&model, &problem, &warning, content.data(), size, "");
  if (!buffers.problem.empty()) throw Error(buffers.problem);
  if (loaded) return;
  constexpr std::size_t kMost = 300;  // tinygltf quotes what it cannot read, whole
  for (char& c : problem) c = c == '\n' ? ' ' : c;
  problem.resize(std::min(problem.size(), kMost));
  problem.resize(problem.find_last_not_of(' ') + 1);
  throw Error(file, "is no readable glTF: " + problem);
}

}  // namespace

void GltfPart::transform(const Pose& pose) {
  mesh.transform(pose);
  for (Eigen::Vector3d& normal : normals) normal = pose.linear() * normal;
}

std::vector<GltfPart> read_gltf(const std::filesystem::path& path) {
  Reader reader{path.string(), {}, 0, {}, 0, {}};
  load(path, reader.model);
  if (reader.model.scenes.empty()) throw Error(path.string(), "/scenes", "is empty, expected at least one scene");
  const int scene = std::max(reader.model.defaultScene, 0);
  if (scene >= static_cast<int>(reader.model.scenes.size())) throw Error(path.string(), "/scene", "does not exist");
  reader.placed_nodes.resize(reader.model.nodes.size());
  for (const int node : reader.model.scenes[scene].nodes) reader.add_node(node, Eigen::Matrix4d::Identity(), 0);
  std::vector<GltfPart> parts;
  for (auto& [key, part] : reader.parts) parts.push_back(std::move(part));
  if (parts.empty()) throw Error(path.string(), "has no triangles");
  return parts;
}

}  // namespace fathom
