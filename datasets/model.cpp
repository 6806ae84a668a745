#include "datasets/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.h"
#include "core/files.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/scene.h"

namespace fathom {
namespace {

constexpr double kAnyWavelength_nm = 830.0;  // clear walls only have their places here, which no wavelength changes

/// What says what a thing is, without its place and its contents.
std::string key_of(bool is_cup, const Json& entry) {
  if (!is_cup) return entry.at("solid").dump();
  return entry.at("shape").dump() + entry.value("glaze", Json()).dump();
}

Scene alone_at_origin(bool is_cup, Json entry, const std::string& file) {
  entry["position_mm"] = {0.0, 0.0};
  Scene scene;
  scene.desk.reset();
  if (is_cup)
    scene.cups.push_back(cup_from_json(JsonReader(entry, file)));
  else
    scene.objects.push_back(object_from_json(JsonReader(entry, file)));
  return scene;
}

/// The largest distance of two vertices, as the largest width in 2,000 directions (a Fibonacci lattice): at most a
/// thousandth too small, and linear in the number of vertices.
double diameter_of(const Mesh& mesh) {
  constexpr int kDirections = 2000;
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  double widest = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double z = (i + 0.5) / kDirections, radius = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(radius * std::cos(i * golden_angle), radius * std::sin(i * golden_angle), z);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      const double along = direction.dot(vertex);
      low = std::min(low, along), high = std::max(high, along);
    }
    widest = std::max(widest, high - low);
  }
  return widest;
}

/// Whether it is a body of revolution about its z axis: as wide as it is deep, with nothing in the corners.
bool is_round(const Model& model) {
  constexpr double kRound = 1e-3;  // of its width: facets
  const Eigen::Vector3d size = model.box.sizes();
  double radius = 0.0;
  for (const Eigen::Vector3d& vertex : model.mesh.vertices) radius = std::max(radius, vertex.head<2>().norm());
  return std::abs(size.x() - size.y()) < kRound * size.x() && std::abs(2.0 * radius - size.x()) < kRound * size.x();
}

/// Whether a point is near one of many.
class NearPoints {
 public:
  NearPoints(const std::vector<Eigen::Vector3d>& points, double near) : near_(near) {
    for (const Eigen::Vector3d& point : points) cells_[cell_of(point)].push_back(point);
  }

  bool has(const Eigen::Vector3d& point) const {
    const Cell cell = cell_of(point);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (const auto found = cells_.find({cell[0] + x, cell[1] + y, cell[2] + z}); found != cells_.end())
            for (const Eigen::Vector3d& other : found->second)
              if ((point - other).norm() <= near_) return true;
    return false;
  }

 private:
  using Cell = std::array<int, 3>;
  Cell cell_of(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d cell = (point / near_).array().floor();
    return {static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z())};
  }

  double near_;
  std::map<Cell, std::vector<Eigen::Vector3d>> cells_;
};

/// The turns by right angles about the box's centre that leave the thing as it is; of a round one, whose turns about
/// its axis are symmetries anyway, the one upside down.
std::vector<Pose> discrete_symmetries(const Model& model) {
  constexpr double kSame = 1e-3;  // of the diameter
  const double near = kSame * model.diameter;
  const NearPoints vertices(model.mesh.vertices, near);
  std::vector<Pose> symmetries;
  const auto try_turn = [&](const Eigen::Matrix3d& turn) {
    Pose moved = Pose::Identity();
    moved.linear() = turn;
    moved.translation() = model.box.center() - turn * model.box.center();
    const bool is_same = std::all_of(model.mesh.vertices.begin(), model.mesh.vertices.end(),
                                     [&](const Eigen::Vector3d& vertex) { return vertices.has(moved * vertex); });
    if (is_same) symmetries.push_back(moved);
  };
  if (is_round(model)) {
    try_turn(Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal());
    return symmetries;
  }
  for (int along = 0; along < 6; ++along)  // where x and y go; z follows
    for (int across = 0; across < 6; ++across) {
      if (along / 2 == across / 2 || (along == 0 && across == 2)) continue;
      const auto axis = [](int number) -> Eigen::Vector3d {
        return (number % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(number / 2);
      };
      Eigen::Matrix3d turn;
      turn << axis(along), axis(across), axis(along).cross(axis(across));
      try_turn(turn);
    }
  return symmetries;
}

/// Row by row, lengths in mm.
Json symmetry_json(const Pose& pose) {
  Json numbers = Json::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      numbers.push_back(pose.matrix()(row, column) * (row < 3 && column == 3 ? 1e3 : 1.0));
  return numbers;
}

}  // namespace

Json json_in_mm(const Eigen::Vector3d& metres) {
  return {mm_from_metres(metres.x()), mm_from_metres(metres.y()), mm_from_metres(metres.z())};
}

Models::Models(const ClutterSpec& clutter) {
  for (const ClutterThing& kind : clutter.cup_kinds) add(true, kind.entry, clutter.file);
  for (const ClutterThing& kind : clutter.object_kinds) add(false, kind.entry, clutter.file);
}

void Models::add(bool is_cup, const Json& entry, const std::string& file) {
  const std::string key = key_of(is_cup, entry);
  for (std::size_t i = 0; i < keys_.size(); ++i)
    if (keys_[i] == key && models_[i].is_cup == is_cup) return;
  const Scene scene = alone_at_origin(is_cup, entry, file);
  Model model{.id = static_cast<int>(models_.size()) + 1,
              .name = is_cup ? cup_name(scene.cups[0]) : object_name(scene.objects[0]),
              .is_cup = is_cup,
              .geometry = std::make_unique<Geometry>(build_geometry(scene, kAnyWavelength_nm))};
  model.alone = std::make_unique<Intersector>(*model.geometry);
  model.alone_from_model = model.geometry->world_from_object.at(0);
  for (const Surface& surface : model.geometry->surfaces) model.mesh.append(surface.mesh);
  model.mesh.transform(model.alone_from_model.inverse());
  for (const Eigen::Vector3d& vertex : model.mesh.vertices) model.box.extend(vertex);
  model.diameter = diameter_of(model.mesh);
  models_.push_back(std::move(model));
  keys_.push_back(key);
}

const Model& Models::find(bool is_cup, const Json& entry) const {
  const std::string key = key_of(is_cup, entry);
  for (std::size_t i = 0; i < keys_.size(); ++i)
    if (keys_[i] == key && models_[i].is_cup == is_cup) return models_[i];
  throw Error("data set", key, "is no kind of the specification");
}

void write_model(const std::filesystem::path& path, const Model& model) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment mm\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      model.mesh.vertices.size(), model.mesh.triangles.size());
  for (const Eigen::Vector3d& v : model.mesh.vertices)
    text += fmt::format("{:.6g} {:.6g} {:.6g}\n", 1e3 * v.x(), 1e3 * v.y(), 1e3 * v.z());
  for (const Eigen::Vector3i& t : model.mesh.triangles) text += fmt::format("3 {} {} {}\n", t.x(), t.y(), t.z());
  write_text(path, text);
}

Json models_info(const Models& models) {
  Json info = Json::object();
  for (const Model& model : models.all()) {
    const Eigen::Vector3d low = 1e3 * model.box.min(), size = 1e3 * model.box.sizes();
    Json entry = {{"name", model.name},
                  {"category", model.is_cup ? "cup" : "thing"},
                  {"diameter", 1e3 * model.diameter},
                  {"min_x", low.x()},
                  {"min_y", low.y()},
                  {"min_z", low.z()},
                  {"size_x", size.x()},
                  {"size_y", size.y()},
                  {"size_z", size.z()}};
    if (is_round(model)) entry["symmetries_continuous"] = Json::array({{{"axis", {0, 0, 1}}, {"offset", {0, 0, 0}}}});
    for (const Pose& symmetry : discrete_symmetries(model))
      entry["symmetries_discrete"].push_back(symmetry_json(symmetry));
    info[fmt::format("{}", model.id)] = std::move(entry);
  }
  return info;
}

}  // namespace fathom
