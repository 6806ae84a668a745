// The kinds of things that stand in a data set's frames, each as a model of its own: its mesh, and what it would hide
// alone.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "core/json.h"
#include "sim/render/intersect.h"
#include "sim/scene/clutter.h"
#include "sim/scene/geometry.h"

namespace fathom {

/// A kind of cup or of other things. Its own frame is that of Geometry::world_from_object: z up, of a cup the axis at
/// the origin and the desk at 0.
struct Model {
  int id;            ///< from 1, BOP's obj_id
  std::string name;  ///< "mug"
  bool is_cup;
  Mesh mesh{};  ///< own frame [m]
  Eigen::AlignedBox3d box{};
  double diameter = 0.0;                 ///< [m] the largest distance of two of its points
  std::unique_ptr<Geometry> geometry;    ///< alone, without a desk
  std::unique_ptr<Intersector> alone{};  ///< of `geometry`
  Pose alone_from_model{};               ///< where it stands there
};

class Models {
 public:
  explicit Models(const ClutterSpec& clutter);

  const std::vector<Model>& all() const { return models_; }
  /// The model of an entry of a scene's `cups` or `objects`, wherever that stands and whatever it holds.
  const Model& of_cup(const Json& entry) const { return find(true, entry); }
  const Model& of_thing(const Json& entry) const { return find(false, entry); }

 private:
  const Model& find(bool is_cup, const Json& entry) const;
  void add(bool is_cup, const Json& entry, const std::string& file);

  std::vector<Model> models_;
  std::vector<std::string> keys_;
};

/// Three numbers in mm.
Json json_in_mm(const Eigen::Vector3d& metres);

/// Mesh in mm as BOP's models are.
void write_model(const std::filesystem::path& path, const Model& model);

/// BOP's models_info.json: boxes and diameters in mm; bodies of revolution are symmetric about their axis,
/// others by the turns through right angles that leave them as they are.
Json models_info(const Models& models);

}  // namespace fathom
