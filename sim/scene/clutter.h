// Random desks: cups among other things, each a scene file that can be shot again from its seed and number.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/json_fwd.h"
#include "sim/scene/footprint.h"

namespace fathom {

/// A kind of thing that may stand on the desk: an entry of a scene's `cups` or `objects`, but for its place.
struct ClutterThing {
  SharedJson entry;
  Footprint footprint;  ///< at the origin, not turned
};

struct ClutterSpec {
  struct Count {
    int low, high;
  };

  SharedJson source;                               ///< the file's text
  std::string file;                                ///< where that stands; what its scenes name lies beside it
  SharedJson sensor, desk = SharedJson::object();  ///< as in a scene file
  Count cups{1, 1}, objects{3, 6};
  std::vector<ClutterThing> cup_kinds, object_kinds;
  std::vector<SharedJson> fillings{SharedJson::object()};  ///< what a cup may hold: {"liquid", "fill_mm"}, or nothing
  double empty = 0.0;                                      ///< share of the cups that stay empty and draw no filling
  Eigen::AlignedBox2d region;                              ///< [m] where cups and objects have their origins
  double gap = 0.010;                                      ///< [m] least distance between things that do not touch
  double touching = 0.0;                                   ///< share of the objects that are pushed against a cup …
  double occluding = 0.0;  ///< … and of those that are put between a cup and the sensor
};

/// Throws Error naming file, path, what is wrong and what is allowed.
ClutterSpec clutter_spec_from_json(const JsonReader& json);
ClutterSpec read_clutter_spec(const std::filesystem::path& path);

/// The objects of a clutter file; the keys of what stands on the desk and the objects that they name, which data sets
/// have as well.
std::vector<KeyTable> clutter_key_tables();
std::vector<KeyRow> thing_keys();
std::vector<KeyTable> thing_key_tables();

/// The scene of that number, as its file would say it. Throws Error when the region has no room for so many things.
Json random_scene(const ClutterSpec& spec, std::uint64_t seed, std::uint64_t number);

}  // namespace fathom
