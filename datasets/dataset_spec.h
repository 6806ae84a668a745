// What the frames of a data set are drawn from: cups, liquids, clutter, where the sensor stands, which unit it is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "sim/scene/clutter.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"

namespace fathom {

/// Intervals are drawn from evenly.
struct DatasetSpec {
  Json source;          ///< the file's text, with what it leaves out
  ClutterSpec clutter;  ///< its sensor, desk and fillings are drawn anew for each frame
  std::vector<std::string> sensors;
  std::vector<Rig> rigs;  ///< of the sensors' models, somewhere
  int units = 1000;       ///< serial numbers of the sensor, from 1
  Interval height_mm{500.0, 800.0}, aim_x_mm{0.0, 0.0}, aim_y_mm{350.0, 350.0}, roll_deg{0.0, 0.0};
  Interval desk_albedo{0.55, 0.55};
  std::vector<Json> liquids;       ///< as under a cup's "liquid"
  Interval fill_share{0.1, 0.95};  ///< of the cup's depth
  double empty = 0.3;              ///< share of the cups that hold nothing
  CaptureMode mode = CaptureMode::geometric;
  std::optional<LightModel> light = {};  ///< of photometric frames; ordinary_light() if it is not given
};

/// Keys that the file leaves out have the values of the shipped specification. `seed` draws the shapes of cups that are
/// given by ranges. Throws Error naming file, path, what is wrong and what is allowed.
DatasetSpec read_dataset_spec(const std::filesystem::path& path, std::uint64_t seed);
/// The same of what stands in `file`.
DatasetSpec dataset_spec_from_json(const Json& json, const std::string& file, std::uint64_t seed);

/// The specification that comes with the program: scenes/datasets/cups.json.
std::filesystem::path shipped_dataset_spec();

/// The file's objects, with the values of that specification.
std::vector<KeyTable> dataset_key_tables();

/// The scene of a frame, as its file would say it: the same whatever other frames are drawn.
Json dataset_scene(const DatasetSpec& spec, std::uint64_t seed, std::uint64_t frame);

}  // namespace fathom
