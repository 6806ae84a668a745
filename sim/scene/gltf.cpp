#include "sim/scene/gltf.h"

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_USE_CPP14
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "core/error.h"

namespace fathom {
namespace {

/// A model with its file's name, so that every error can say where it is.
struct Reader {
  std::string file;
  tinygltf::Model model;
  std::map<int, Mesh> meshes_by_material;

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

  void add_primitive(const tinygltf::Primitive& primitive, const Eigen::Matrix4d& scene_from_node,
                     const std::string& where) {
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1)
      fail(where, "is no list of triangles, the only kind supported");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) fail(where, "has no POSITION");
    const Bytes source = bytes(position->second, TINYGLTF_TYPE_VEC3, where);
    if (source.component != TINYGLTF_COMPONENT_TYPE_FLOAT) fail(where, "has positions that are not floats");
    Mesh part;
    for (std::size_t i = 0; i < source.count; ++i) {
      Eigen::Vector3f value;
      std::memcpy(value.data(), source.data + i * source.stride, sizeof(float) * 3);
      const Eigen::Vector3d in_scene = (scene_from_node * value.cast<double>().homogeneous()).head<3>();
      if (!in_scene.allFinite()) fail(where, "has a position that is not finite");
      part.add_vertex({in_scene.x(), -in_scene.z(), in_scene.y()});
    }
    const std::vector<int> corners = indices(primitive, source.count, where);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      part.add_triangle(corners[i], corners[i + 1], corners[i + 2]);
    meshes_by_material[primitive.material].append(part);
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
    if (depth > 100) fail(where, "is nested more than 100 deep, or in a circle");
    const tinygltf::Node& node = model.nodes[index];
    const Eigen::Matrix4d scene_from_node = scene_from_parent * local_transform(node);
    if (node.mesh >= static_cast<int>(model.meshes.size())) fail(where, "names a mesh that does not exist");
    if (node.mesh >= 0) {
      const auto& primitives = model.meshes[node.mesh].primitives;
      for (std::size_t i = 0; i < primitives.size(); ++i)
        add_primitive(primitives[i], scene_from_node, fmt::format("/meshes/{}/primitives/{}", node.mesh, i));
    }
    for (const int child : node.children) add_node(child, scene_from_node, depth + 1);
  }

  double albedo(int material) const {
    if (material < 0) return 0.5;
    const std::string where = fmt::format("/materials/{}", material);
    if (material >= static_cast<int>(model.materials.size())) fail(where, "does not exist");
    const tinygltf::Material& source = model.materials[material];
    if (source.extensions.contains("KHR_materials_transmission"))
      fail(where, "is transmissive; refracting glTF bodies are not modelled yet, only opaque ones");
    const std::vector<double>& colour = source.pbrMetallicRoughness.baseColorFactor;
    if (colour.size() != 4) fail(where, "has a base colour that is not 4 numbers");
    return std::clamp(0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2], 0.0, 1.0);
  }
};

}  // namespace

std::vector<GltfPart> read_gltf(const std::filesystem::path& path) {
  Reader reader{path.string(), {}, {}};
  if (!std::filesystem::is_regular_file(path)) throw Error(path.string(), "no such file");
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  std::string problem, warning;
  const bool loaded = path.extension() == ".glb"
                          ? loader.LoadBinaryFromFile(&reader.model, &problem, &warning, path.string())
                          : loader.LoadASCIIFromFile(&reader.model, &problem, &warning, path.string());
  if (!loaded) {
    while (!problem.empty() && (problem.back() == '\n' || problem.back() == ' ')) problem.pop_back();
    for (char& c : problem) c = c == '\n' ? ' ' : c;
    throw Error(path.string(), "is no readable glTF: " + problem);
  }
  if (reader.model.scenes.empty()) throw Error(path.string(), "/scenes", "is empty, expected at least one scene");
  const int scene = std::max(reader.model.defaultScene, 0);
  if (scene >= static_cast<int>(reader.model.scenes.size())) throw Error(path.string(), "/scene", "does not exist");
  for (const int node : reader.model.scenes[scene].nodes) reader.add_node(node, Eigen::Matrix4d::Identity(), 0);
  std::vector<GltfPart> parts;
  for (auto& [material, mesh] : reader.meshes_by_material) parts.push_back({std::move(mesh), reader.albedo(material)});
  if (parts.empty()) throw Error(path.string(), "has no triangles");
  return parts;
}

}  // namespace fathom
