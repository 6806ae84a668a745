#include "sim/scene/gltf_export.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "core/error.h"
#include "core/units.h"
#include "core/visible_text.h"
#include "sim/scene/cup.h"
#include "sim/scene/cup_mesh.h"
#include "sim/scene/liquid_top.h"

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

/// A glTF 2.0 model while it is put together: one node for each thing, in metres, +Y up.
class GltfModel {
 public:
  /// Media are written at this wavelength.
  explicit GltfModel(double wavelength_nm) : wavelength_nm_(wavelength_nm) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Fathom";
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
  }

  /// A node with a mesh of these parts, z up in the world. Parts of one material become one primitive.
  void add(const std::string& name, const std::vector<GltfPart>& parts) {
    const std::string shown = visible_text(name);
    std::map<std::pair<int, bool>, Triangles> primitives;  // by material, whether they have normals
    for (const GltfPart& part : parts)
      primitives[{material({part.albedo, part.coat, part.medium}, shown), !part.normals.empty()}].add(part);
    tinygltf::Mesh mesh;
    mesh.name = shown;
    for (const auto& [key, triangles] : primitives) {
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.material = key.first;
      primitive.attributes["POSITION"] = positions(triangles.positions);
      if (key.second) primitive.attributes["NORMAL"] = vectors(triangles.normals);
      primitive.indices = accessor(triangles.corners.data(), triangles.corners.size() * sizeof triangles.corners[0],
                                   triangles.corners.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
      mesh.primitives.push_back(std::move(primitive));
    }
    model_.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.name = shown;
    node.mesh = static_cast<int>(model_.meshes.size()) - 1;
    add_node(std::move(node));
  }

  /// The field of view of the rig's depth image. A principal point off the middle cannot be said.
  void add_camera(const std::string& name, const Rig& rig) {
    tinygltf::Camera camera;
    camera.name = name;
    camera.type = "perspective";
    camera.perspective.yfov = 2.0 * std::atan(0.5 * rig.sensor.height / rig.sensor.focal_px);
    camera.perspective.aspectRatio = static_cast<double>(rig.sensor.width) / rig.sensor.height;
    camera.perspective.znear = 0.01;
    camera.perspective.zfar = rig.sensor.law.far;
    model_.cameras.push_back(camera);
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
    add_node(std::move(node));
  }

  /// The .glb file.
  std::string bytes() {
    model_.extensionsUsed.assign(extensions_.begin(), extensions_.end());
    std::ostringstream stream;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, false, true))
      throw Error("the scene cannot be written as glTF");
    return stream.str();
  }

 private:
  int accessor(const void* data, std::size_t bytes, std::size_t count, int component, int type, int target) {
    std::vector<unsigned char>& buffer = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = bytes;
    view.target = target;
    model_.bufferViews.push_back(view);
    buffer.resize(buffer.size() + bytes);
    std::memcpy(buffer.data() + view.byteOffset, data, bytes);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int vectors(const std::vector<Eigen::Vector3f>& values) {
    return accessor(values.data(), values.size() * sizeof values[0], values.size(), TINYGLTF_COMPONENT_TYPE_FLOAT,
                    TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  }

  int positions(const std::vector<Eigen::Vector3f>& values) {
    const int number = vectors(values);
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& value : values) box.extend(value);
    model_.accessors[number].minValues.assign(box.min().begin(), box.min().end());
    model_.accessors[number].maxValues.assign(box.max().begin(), box.max().end());
    return number;
  }

  void use(tinygltf::Material& material, const char* extension, Value::Object content) {
    material.extensions[extension] = Value(std::move(content));
    extensions_.insert(extension);
  }

  void make_clear(tinygltf::Material& material, const Medium& medium) {
    material.name = visible_text(medium.name);
    material.pbrMetallicRoughness.roughnessFactor = 0.0;
    use(material, "KHR_materials_transmission", {{"transmissionFactor", Value(1.0)}});
    use(material, "KHR_materials_ior", {{"ior", Value(medium.n(wavelength_nm_))}});
    use(material, "KHR_materials_volume", volume_of(medium));
    material.extras = Value(Value::Object{{"absorption_per_mm", Value(per_mm_from_per_metre(medium.absorption))},
                                          {"scattering_per_mm", Value(per_mm_from_per_metre(medium.scattering))},
                                          {"anisotropy", Value(medium.anisotropy)}});
  }

  int material(const Look& look, const std::string& name) {
    for (std::size_t i = 0; i < looks_.size(); ++i)
      if (looks_[i] == look) return static_cast<int>(i);
    looks_.push_back(look);
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
    model_.materials.push_back(std::move(material));
    return static_cast<int>(looks_.size()) - 1;
  }

  void add_node(tinygltf::Node node) {
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(node));
  }

  double wavelength_nm_;
  tinygltf::Model model_;
  std::vector<Look> looks_;  ///< of the model's materials
  std::set<std::string> extensions_;
};

/// The body under a liquid's surface; in a cup from a mesh its surface alone.
GltfPart liquid_part(const Cup& cup, double wavelength_nm) {
  const Medium& medium = cup.filling->medium;
  GltfPart part;
  if (medium.scatters())
    part.albedo = diffuse_reflectance(medium, medium.n(wavelength_nm));
  else
    part.medium = medium;
  const auto* shape = std::get_if<CupShape>(&cup.shape);
  if (!shape) {
    part.mesh = liquid_surface(cup);
  } else {
    const LiquidTop top(*shape, liquid_level(cup), cup.filling->form);
    part.mesh = top.mesh(*shape);
    part.mesh.append(liquid_shell(*shape, top, part.mesh));
    part.mesh.transform(Pose(Eigen::Translation3d(cup.position.x(), cup.position.y(), 0.0)));
  }
  return part;
}

/// Those of the smooth piece that its triangles stand for: means over triangles would lean by a part of a facet, and
/// glass would bend light by that.
std::vector<Eigen::Vector3d> exact_normals(const WallPart& wall) {
  const Mesh& mesh = wall.mesh;
  const Eigen::Vector3i first = mesh.triangles.front();
  const Eigen::Vector3d corner = mesh.vertices[first[0]];
  const Eigen::Vector3d facing =
      (mesh.vertices[first[1]] - corner).cross(mesh.vertices[first[2]] - corner).normalized();
  const auto smooth = [&](const Eigen::Vector3d& vertex) {
    const double radius = vertex.head<2>().norm();
    if (!wall.cone || radius == 0.0) return Eigen::Vector3d(0.0, 0.0, facing.z() < 0.0 ? -1.0 : 1.0);
    return Eigen::Vector3d(vertex.x() / radius, vertex.y() / radius, -wall.cone->y()).normalized();
  };
  std::vector<Eigen::Vector3d> normals;
  const double side = smooth(corner).dot(facing) < 0.0 ? -1.0 : 1.0;
  for (const Eigen::Vector3d& vertex : mesh.vertices) normals.push_back(side * smooth(vertex));
  return normals;
}

/// A cup of revolution piece by piece, so that each is smooth and edges stay sharp.
std::vector<GltfPart> wall_pieces(const Cup& cup) {
  const auto* shape = std::get_if<CupShape>(&cup.shape);
  if (!shape) return cup_parts(cup);
  std::vector<GltfPart> pieces;
  const auto add = [&](const Mesh& mesh, std::vector<Eigen::Vector3d> normals) {
    GltfPart& piece = pieces.emplace_back();
    piece.mesh = mesh;
    piece.normals = std::move(normals);
    piece.albedo = shape->albedo;
    piece.coat = shape->glaze;
    piece.medium = shape->material;
    piece.transform(world_from_shape(cup));
  };
  for (const WallPart& wall : wall_parts(*shape, 0.0)) add(wall.mesh, exact_normals(wall));
  if (shape->handle) {
    const Mesh handle = handle_mesh(*shape);
    add(handle, vertex_normals(handle));
  }
  return pieces;
}

}  // namespace

std::string glb_of_scene(const Setup& setup) {
  const Scene& scene = setup.scene;
  GltfModel model(setup.rig.sensor.wavelength_nm);
  if (scene.desk) model.add("desk", {desk_part(*scene.desk)});
  for (std::size_t i = 0; i < scene.cups.size(); ++i) {
    const Cup& cup = scene.cups[i];
    model.add(fmt::format("cup {} {}", i, cup_name(cup)), wall_pieces(cup));
    if (cup.filling)
      model.add(fmt::format("cup {} {}", i, cup.filling->medium.name),
                {liquid_part(cup, setup.rig.sensor.wavelength_nm)});
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    model.add(fmt::format("object {} {}", i, object_name(scene.objects[i])), object_parts(scene.objects[i]));
  model.add_camera("infrared camera", setup.rig);
  return model.bytes();
}

std::string glb_of_cup(const Cup& cup, double wavelength_nm) {
  Cup alone = cup;
  alone.position.setZero();
  alone.yaw = 0.0;
  if (auto* mesh = std::get_if<MeshCup>(&alone.shape))
    for (GltfPart& part : mesh->parts) part.transform(mesh->world_from_mesh.inverse());
  GltfModel model(wavelength_nm);
  model.add(cup_name(cup), wall_pieces(alone));
  return model.bytes();
}

}  // namespace fathom
