// A scene file read whole: what stands there, who looks at it, and which effects are switched on.
#pragma once

#include <filesystem>

#include "sim/scene/rig.h"
#include "sim/scene/scene.h"

namespace fathom {

/// When a shot is taken, and of what as far as the laboratory knows.
struct Circumstances {
  double time_s = 0.0;               ///< of frame 0, since the session began
  double stood_s = 0.0;              ///< how long the cups have been filled by then
  std::string liquid;                ///< as labelled; empty: by the medium's name
  std::vector<Medium> liquids = {};  ///< all that the campaign pours, in the order of their labels

  bool operator==(const Circumstances&) const = default;
};

/// Disparities that differ by less [px] belong to one surface, for windows that average.
inline constexpr double kOneSurfacePx = 1.0;

/// How what a camera sees becomes what is compared, beyond the sensor's own model.
struct Processing {
  double window_px = 0.0;    ///< disparities are means over a square of this width, within a surface; 0: own
  bool colour_view = false;  ///< depths are moved to where the colour camera has them (sim/sensor/depth.h)
  double bisector = 0.0;     ///< share of the paper's approximation in what is predicted of raised bottoms, 0 … 1

  bool operator==(const Processing&) const = default;
};

/// Shares of the light that takes other ways than from the projector to what the camera sees; images only have all or
/// none of it.
struct IndirectLight {
  double interreflected = 0.0;  ///< from wall to wall
  double mirrored = 0.0;        ///< in surfaces of liquids

  bool any() const { return interreflected > 0.0 || mirrored > 0.0; }

  bool operator==(const IndirectLight&) const = default;
};

struct Setup {
  Scene scene;
  Rig rig;
  SharedJson source = {};                        ///< the file's text, kept for run.json
  std::string file = {};                         ///< its name, for errors
  SharedJson effects = SharedJson::array();      ///< to be switched on by sim/effects; as in the file
  SharedJson switched_on = SharedJson::array();  ///< those that are, in their order
  Circumstances circumstances = {};
  Processing processing = {};
  IndirectLight light = {};

  /// Whether the same is shot, whatever file says it.
  bool operator==(const Setup& other) const;
};

/// Reads a scene file. Throws Error naming file, path, what is wrong and what is allowed.
Setup read_setup(const std::filesystem::path& path);
/// The same of what stands in `file`.
Setup whole_setup_from_json(const Json& json, const std::string& file);
/// The same without a look at the files that objects name; `pointer` is where in the file it stands.
Setup setup_from_json(const Json& json, const std::string& file, const std::string& pointer = "");

/// The objects of a scene file.
std::vector<KeyTable> setup_key_tables();

/// How it is processed and what light is added, for run.json.
Json json_from_processing(const Processing& processing);
Json json_from_light(const IndirectLight& light);

/// Throws Error, as coming from `json`, when the medium's numbers do not hold at the sensor's wavelength.
void require_index(const JsonReader& json, const Medium& medium, double wavelength_nm);

}  // namespace fathom
