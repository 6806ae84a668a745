#include "sim/optics/layers.h"

#include <cassert>

namespace fathom {

LayerSpace::LayerSpace(std::vector<Layer> layers) : layers_(std::move(layers)), face_z_{0.0} {
  assert(!layers_.empty());
  for (const Layer& layer : layers_) {
    assert(layer.thickness > 0.0 && std::isfinite(face_z_.back()));
    face_z_.push_back(face_z_.back() - layer.thickness);
  }
}

}  // namespace fathom
