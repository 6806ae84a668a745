#include "sim/scene/gltf_model.h"

#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/units.h"
#include "core/visible_text.h"

namespace fathom {
namespace {

using Value = tinygltf::Value;

/// What makes a material another one.
struct Look {
  double albedo;
  std::optional<Coat> coat;
  std::optional<Medium> medium;

  bool operator==(const Look&) const = default;
};

Eigen::Vector3f y_up(const Eigen::Vector3d& z_up) {
  return Eigen::Vector3d(z_up.x(), z_up.z(), -z_up.y()).cast<float>();
}

/// Several parts as one list of triangles.
struct Triangles {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<std::uint32_t> corners;

  void add(const GltfPart& part) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Eigen::Vector3d& vertex : part.mesh.vertices) positions.push_back(y_up(vertex));
    for (const Eigen::Vector3d& normal : part.normals) normals.push_back(y_up(normal).normalized());
    for (const Eigen::Vector3i& triangle : part.mesh.triangles)
      for (const int corner : triangle) corners.push_back(first + static_cast<std::uint32_t>(corner));
  }
};

/// A medium that absorbs nothing needs no colour; one that does keeps 1/e of white after 1/μa.
Value::Object volume_of(const Medium& medium) {
  constexpr double kThickness = 1e-3;  // [m] more than 0 says that the mesh encloses a volume
  Value::Object volume{{"thicknessFactor", Value(kThickness)}};
  if (medium.absorption > 0.0) {
    const Value left(std::exp(-1.0));
    volume["attenuationDistance"] = Value(1.0 / medium.absorption);
    volume["attenuationColor"] = Value(Value::Array{left, left, left});
  }
  return volume;
}

}  // namespace

struct GltfModel::Impl {
  double wavelength_nm;
  tinygltf::Model model;
  std::vector<Look> looks;  ///< of the model's materials
  std::set<std::string> extensions;

  int accessor(const void* data, std::size_t bytes, std::size_t count, int component, int type, int target) {
    std::vector<unsigned char>& buffer = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = bytes;
    view.target = target;
    model.bufferViews.push_back(view);
    buffer.resize(buffer.size() + bytes);
    std::memcpy(buffer.data() + view.byteOffset, data, bytes);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
  }

  int vectors(const std::vector<Eigen::Vector3f>& values) {
    return accessor(values.data(), values.size() * sizeof values[0], values.size(), TINYGLTF_COMPONENT_TYPE_FLOAT,
                    TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  }

  int positions(const std::vector<Eigen::Vector3f>& values) {
    const int number = vectors(values);
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& value : values) box.extend(value);
    model.accessors[number].minValues.assign(box.min().begin(), box.min().end());
    model.accessors[number].maxValues.assign(box.max().begin(), box.max().end());
    return number;
  }

  void use(tinygltf::Material& material, const char* extension, Value::Object content) {
    material.extensions[extension] = Value(std::move(content));
    extensions.insert(extension);
  }

  void make_clear(tinygltf::Material& material, const Medium& medium) {
    material.name = visible_text(medium.name);
    material.pbrMetallicRoughness.roughnessFactor = 0.0;
    use(material, "KHR_materials_transmission", {{"transmissionFactor", Value(1.0)}});
    use(material, "KHR_materials_ior", {{"ior", Value(medium.n(wavelength_nm))}});
    use(material, "KHR_materials_volume", volume_of(medium));
    material.extras = Value(Value::Object{{"absorption_per_mm", Value(medium.absorption * kMetresPerMm)},
                                          {"scattering_per_mm", Value(medium.scattering * kMetresPerMm)},
                                          {"anisotropy", Value(medium.anisotropy)}});
  }

  int material(const Look& look, const std::string& name) {
    for (std::size_t i = 0; i < looks.size(); ++i)
      if (looks[i] == look) return static_cast<int>(i);
    looks.push_back(look);
    tinygltf::Material material;
    material.name = name;
    material.doubleSided = !look.medium;
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    if (look.medium) {
      make_clear(material, *look.medium);
    } else {
      material.pbrMetallicRoughness.baseColorFactor = {look.albedo, look.albedo, look.albedo, 1.0};
      if (look.coat) {
        material.pbrMetallicRoughness.roughnessFactor = std::sqrt(look.coat->roughness);
        use(material, "KHR_materials_ior", {{"ior", Value(look.coat->index)}});
      }
    }
    model.materials.push_back(std::move(material));
    return static_cast<int>(looks.size()) - 1;
  }

  void add_node(tinygltf::Node node) {
    model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(std::move(node));
  }
};

GltfModel::GltfModel(double wavelength_nm) : impl_(std::make_unique<Impl>()) {
  impl_->wavelength_nm = wavelength_nm;
  impl_->model.asset.version = "2.0";
  impl_->model.asset.generator = "Fathom";
  impl_->model.buffers.emplace_back();
  impl_->model.scenes.emplace_back();
  impl_->model.defaultScene = 0;
}

GltfModel::~GltfModel() = default;

void GltfModel::add(const std::string& name, const std::vector<GltfPart>& parts) {
  const std::string shown = visible_text(name);
  std::map<std::pair<int, bool>, Triangles> primitives;  // by material, whether they have normals
  for (const GltfPart& part : parts)
    primitives[{impl_->material({part.albedo, part.coat, part.medium}, shown), !part.normals.empty()}].add(part);
  tinygltf::Mesh mesh;
  mesh.name = shown;
  for (const auto& [key, triangles] : primitives) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = key.first;
    primitive.attributes["POSITION"] = impl_->positions(triangles.positions);
    if (key.second) primitive.attributes["NORMAL"] = impl_->vectors(triangles.normals);
    primitive.indices = impl_->accessor(
        triangles.corners.data(), triangles.corners.size() * sizeof triangles.corners[0], triangles.corners.size(),
        TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    mesh.primitives.push_back(std::move(primitive));
  }
  impl_->model.meshes.push_back(std::move(mesh));
  tinygltf::Node node;
  node.name = shown;
  node.mesh = static_cast<int>(impl_->model.meshes.size()) - 1;
  impl_->add_node(std::move(node));
}

void GltfModel::add_camera(const std::string& name, const Rig& rig) {
  tinygltf::Camera camera;
  camera.name = name;
  camera.type = "perspective";
  camera.perspective.yfov = 2.0 * std::atan(0.5 * rig.sensor.height / rig.sensor.focal_px);
  camera.perspective.aspectRatio = static_cast<double>(rig.sensor.width) / rig.sensor.height;
  camera.perspective.znear = 0.01;
  camera.perspective.zfar = rig.sensor.law.far;
  impl_->model.cameras.push_back(camera);
  // glTF's camera looks along −z with +y up, in a world with +y up.
  Eigen::Matrix3d up, turn;
  up << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  turn << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  const Eigen::Quaterniond rotation(up * rig.world_from_camera.linear() * turn);
  const Eigen::Vector3d place = up * rig.camera_in_world();
  tinygltf::Node node;
  node.name = name;
  node.camera = 0;
  node.translation = {place.x(), place.y(), place.z()};
  node.rotation = {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
  impl_->add_node(std::move(node));
}

std::string GltfModel::bytes() {
  impl_->model.extensionsUsed.assign(impl_->extensions.begin(), impl_->extensions.end());
  std::ostringstream stream;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&impl_->model, stream, false, true))
    throw Error("the scene cannot be written as glTF");
  return stream.str();
}

}  // namespace fathom
