// Reading of what random desks are laid with.
#include <fmt/format.h>

#include "core/units.h"
#include "sim/scene/clutter.h"
#include "sim/scene/cup.h"
#include "sim/scene/medium_json.h"
#include "sim/scene/object.h"
#include "sim/scene/setup.h"

namespace fathom {
namespace {

constexpr int kMostThings = 30;

ClutterSpec::Count count_from_json(const JsonReader& json, ClutterSpec::Count otherwise) {
  if (!json.has("number")) return otherwise;
  const std::vector<JsonReader> ends = json.at("number").items();
  if (ends.size() != 2) json.fail_at("number", "must be two whole numbers, least and most");
  const ClutterSpec::Count count{ends[0].integer(0, kMostThings), ends[1].integer(0, kMostThings)};
  if (count.high < count.low) json.fail_at("number", "must not end below its start");
  return count;
}

/// An entry stands at the origin while it is read; the draw sets its place.
std::vector<ClutterThing> kinds_from_json(const JsonReader& json, std::vector<GltfPart> (*parts)(const JsonReader&)) {
  std::vector<ClutterThing> kinds;
  for (const JsonReader& item : json.at("kinds").items()) {
    for (const char* key : {"position_mm", "yaw_deg", "liquid", "gltf"})
      if (item.has(key)) item.fail_at(key, "cannot stand here");
    if (!item.value().is_object()) item.fail("must be an object");
    const Json entry = item.value();
    Json at_origin = entry;
    at_origin["position_mm"] = {0.0, 0.0};
    kinds.push_back({entry, Footprint(parts(JsonReader(at_origin, item.file(), item.pointer())))});
  }
  if (kinds.empty()) json.fail_at("kinds", "must hold at least one");
  return kinds;
}

Json filling_from_json(const JsonReader& json) {
  json.allow_only({"liquid", "fill_mm"});
  if (json.has("liquid") != json.has("fill_mm")) json.fail("must have both liquid and fill_mm, or neither");
  if (json.has("liquid")) medium_from_json(json.at("liquid"));  // a mistake shows before the first desk
  return json.value();
}

Eigen::AlignedBox2d region_from_json(const JsonReader& json) {
  json.allow_only({"x_mm", "y_mm"});
  const Eigen::Vector2d x = json.at("x_mm").vector2(kCupPlaceMm) * kMetresPerMm,
                        y = json.at("y_mm").vector2(kCupPlaceMm) * kMetresPerMm;
  if (x[1] < x[0]) json.fail_at("x_mm", "must not end below its start");
  if (y[1] < y[0]) json.fail_at("y_mm", "must not end below its start");
  return {Eigen::Vector2d(x[0], y[0]), Eigen::Vector2d(x[1], y[1])};
}

}  // namespace

ClutterSpec clutter_spec_from_json(const JsonReader& json) {
  ClutterSpec spec;
  spec.source = json.value();
  spec.file = json.file();
  json.allow_only(
      {"sensor", "desk", "cups", "objects", "fillings", "empty", "region_mm", "gap_mm", "touching", "occluding"});
  spec.sensor = json.at("sensor").value();
  rig_from_json(json.at("sensor"));
  spec.desk = json.has("desk") ? spec.source["desk"] : Json::object();
  const Json bare{{"desk", spec.desk}};
  if (!scene_from_json(JsonReader(bare, json.file())).desk)
    json.fail_at("desk", "is what things stand on and cannot be null");
  json.at("cups").allow_only({"number", "kinds"});
  spec.cups = count_from_json(json.at("cups"), spec.cups);
  spec.cup_kinds =
      kinds_from_json(json.at("cups"), [](const JsonReader& entry) { return cup_parts(cup_from_json(entry)); });
  json.at("objects").allow_only({"number", "kinds"});
  spec.objects = count_from_json(json.at("objects"), spec.objects);
  spec.object_kinds = kinds_from_json(json.at("objects"),
                                      [](const JsonReader& entry) { return object_parts(object_from_json(entry)); });
  if (json.has("fillings")) {
    spec.fillings.clear();
    for (const JsonReader& item : json.at("fillings").items()) spec.fillings.push_back(filling_from_json(item));
    if (spec.fillings.empty()) json.fail_at("fillings", "must hold at least one; {} leaves a cup empty");
  }
  spec.empty = json.number_or("empty", spec.empty, {0.0, 1.0});
  spec.region = region_from_json(json.at("region_mm"));
  spec.gap = json.metres_or("gap_mm", spec.gap, kCupLengthMm);
  spec.touching = json.number_or("touching", spec.touching, {0.0, 1.0});
  spec.occluding = json.number_or("occluding", spec.occluding, {0.0, 1.0});
  if (spec.touching + spec.occluding > 1.0) json.fail_at("occluding", "must leave touching + occluding at most 1");
  return spec;
}

ClutterSpec read_clutter_spec(const std::filesystem::path& path) {
  const Json json = read_json(path);
  return clutter_spec_from_json(JsonReader(json, path.string()));
}

}  // namespace fathom
