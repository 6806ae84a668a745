// A glTF 2.0 model while it is put together: one node for each thing, in metres, +Y up.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/scene/gltf.h"
#include "sim/scene/rig.h"

namespace fathom {

class GltfModel {
 public:
  /// Media are written at this wavelength.
  explicit GltfModel(double wavelength_nm);
  ~GltfModel();

  /// A node with a mesh of these parts, z up in the world. Parts of one material become one primitive.
  void add(const std::string& name, const std::vector<GltfPart>& parts);
  /// The field of view of the rig's depth image. A principal point off the middle cannot be said.
  void add_camera(const std::string& name, const Rig& rig);
  /// The .glb file.
  std::string bytes();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fathom
