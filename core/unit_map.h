// What was learned of one unit's bias of disparity (fathom calibrate), as the simulator takes it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/image.h"
#include "core/json_fwd.h"

namespace fathom {

/// [px] measured minus true disparity, 640 × 480 each.
struct UnitMap {
  Image<float> reference;     ///< what moves with the reference image
  Image<float> camera;        ///< what stays at the camera's pixels
  double reference_at = 0.0;  ///< [px] a column of `reference` is that of the reference image plus this

  /// Of the reference image's pixel; beyond the map as at its border.
  float reference_of(double column_px, double row_px) const;
  float camera_of(int column, int row) const;

  bool operator==(const UnitMap& other) const;
};

/// The map and the files that it came from.
struct LearnedUnit {
  std::shared_ptr<const UnitMap> map;  ///< nothing: none
  std::string file;                    ///< unit.json
  std::string image;                   ///< as unit.json names it

  /// Maps are the same that hold the same, whatever files they came from.
  bool operator==(const LearnedUnit& other) const;
};

/// Of a unit.json, and the image that it names.
LearnedUnit read_learned_unit(const std::filesystem::path& file);

/// The value is the path of a unit.json, as path_named_in() takes it.
LearnedUnit learned_unit_from_json(const JsonReader& json);

}  // namespace fathom
