// Reading of what random desks are laid with.
#include <fmt/format.h>

#include "core/fields.h"
#include "sim/scene/clutter.h"
#include "sim/scene/cup.h"
#include "sim/scene/medium_json.h"
#include "sim/scene/scene.h"
#include "sim/scene/setup.h"

namespace fathom {
namespace {

constexpr int kMostThings = 30;

ClutterSpec::Count count_from_json(const JsonReader& json) {
  const std::vector<JsonReader> ends = json.items();
  if (ends.size() != 2) json.fail("must be two whole numbers, least and most");
  const ClutterSpec::Count count{ends[0].integer(0, kMostThings), ends[1].integer(0, kMostThings)};
  if (count.high < count.low) json.fail("must not end below its start");
  return count;
}

/// An entry stands at the origin while it is read; the draw sets its place.
std::vector<ClutterThing> kinds_from_json(const JsonReader& json, std::vector<GltfPart> (*parts)(const JsonReader&)) {
  std::vector<ClutterThing> kinds;
  for (const JsonReader& item : json.items()) {
    for (const char* key : {"position_mm", "yaw_deg", "liquid", "gltf"})
      if (item.has(key)) item.fail_at(key, "cannot stand here");
    if (!item.value().is_object()) item.fail("must be an object");
    const Json entry = item.value();
    Json at_origin = entry;
    at_origin["position_mm"] = {0.0, 0.0};
    kinds.push_back({entry, Footprint(parts(JsonReader(at_origin, item.file(), item.pointer())))});
  }
  if (kinds.empty()) json.fail("must hold at least one");
  return kinds;
}

Json filling_from_json(const JsonReader& json) {
  json.allow_only({"liquid", "fill_mm"});
  if (json.has("liquid") != json.has("fill_mm")) json.fail("must have both liquid and fill_mm, or neither");
  if (json.has("liquid")) medium_from_json(json.at("liquid"));  // a mistake shows before the first desk
  return json.value();
}

/// The least and the largest of a region's places along an axis [m].
template <int axis>
Part<Eigen::AlignedBox2d> side() {
  return {[](const JsonReader& json, Eigen::AlignedBox2d& region) {
            const Eigen::Vector2d ends = json.vector2(kCupPlaceMm) * kMetresPerMm;
            if (ends[1] < ends[0]) json.fail("must not end below its start");
            region.min()[axis] = ends[0], region.max()[axis] = ends[1];
          },
          nullptr, "#/$defs/pair", "[least, largest]"};
}

std::span<const Field<Eigen::AlignedBox2d>> region_fields() {
  static const Field<Eigen::AlignedBox2d> fields[] = {{"x_mm", side<0>(), "to the sensor's right", true},
                                                      {"y_mm", side<1>(), "away from it", true}};
  return fields;
}

constexpr std::string_view kCount = "#/$defs/count", kWholePair = "[least, most], each 0 to 30";
Json json_from_count(ClutterSpec::Count count) { return {count.low, count.high}; }

/// How many things of one sort, and which. `schema` and `means` are of the kinds.
template <ClutterSpec::Count ClutterSpec::*count, std::vector<ClutterThing> ClutterSpec::*kinds,
          std::vector<GltfPart> (*parts)(const JsonReader&)>
std::span<const Field<ClutterSpec>> drawn_fields(std::string_view schema, std::string_view means) {
  using Spec = ClutterSpec;
  static const Field<Spec> fields[] = {
      {"number",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { spec.*count = count_from_json(json); },
                  [](const Spec& spec) { return json_from_count(spec.*count); }, kCount, kWholePair},
       "least and most of them"},
      {"kinds",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { spec.*kinds = kinds_from_json(json, parts); }, nullptr,
                  schema, "a list of objects"},
       means, true}};
  return fields;
}

std::vector<GltfPart> parts_of_cup(const JsonReader& json) { return cup_parts(cup_from_json(json)); }
std::vector<GltfPart> parts_of_object(const JsonReader& json) { return object_parts(object_from_json(json)); }

std::span<const Field<ClutterSpec>> cups_fields() {
  return drawn_fields<&ClutterSpec::cups, &ClutterSpec::cup_kinds, parts_of_cup>(
      "#/$defs/cup_kinds", "entries of a scene's `cups` without place and liquid, of which each cup draws one");
}

std::span<const Field<ClutterSpec>> objects_fields() {
  return drawn_fields<&ClutterSpec::objects, &ClutterSpec::object_kinds, parts_of_object>(
      "#/$defs/object_kinds", "entries of a scene's `objects` with `solid` and without place, of which each draws one");
}

/// What stands on the desk, in data sets as well.
std::span<const Field<ClutterSpec>> thing_fields() {
  using Spec = ClutterSpec;
  constexpr Range kShare{0.0, 1.0};
  static const Field<Spec> fields[] = {
      {"cups",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { read_fields(json, cups_fields(), spec); }, nullptr,
                  "#/$defs/cups", "an object"},
       "how many cups, and which", true},
      {"objects",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { read_fields(json, objects_fields(), spec); }, nullptr,
                  "#/$defs/objects", "an object"},
       "how many other things, and which", true},
      {"region_mm",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { read_fields(json, region_fields(), spec.region); }, nullptr,
                  "#/$defs/region", "an object"},
       "where on the desk things have their origins", true},
      {"gap_mm", Length{&Spec::gap}, kCupLengthMm, "least distance between things that do not touch, seen from above"},
      {"touching", &Spec::touching, kShare, "share of the objects that stand within 2 mm of a cup"},
      {"occluding", &Spec::occluding, kShare,
       "share of the objects that stand 20 to 80 mm before a cup, on the sensor's side"}};
  return fields;
}

std::span<const Field<ClutterSpec>> clutter_fields() {
  using Spec = ClutterSpec;
  static const Field<Spec> fields[] = {
      {"sensor",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    rig_from_json(json);
                    spec.sensor = json.value();
                  },
                  nullptr, "../schema.json#/$defs/sensor", "an object"},
       "as in a scene", true},
      {"desk",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    if (json.value().is_null()) json.fail("is what things stand on and cannot be null");
                    desk_from_json(json);
                    spec.desk = json.value();
                  },
                  nullptr, "../schema.json#/$defs/desk", "an object"},
       "as in a scene"},
      {"fillings",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    spec.fillings.clear();
                    for (const JsonReader& item : json.items()) spec.fillings.push_back(filling_from_json(item));
                    if (spec.fillings.empty()) json.fail("must hold at least one; {} leaves a cup empty");
                  },
                  [](const Spec& spec) { return Json(spec.fillings); },
                  R"({"type": "array", "items": {"type": "object"}, "minItems": 1})", "a list of objects"},
       "`{\"liquid\", \"fill_mm\"}`, or `{}` for an empty cup; each cup draws one, with `liquid` every filling has its "
       "own trials"},
      {"empty", &Spec::empty, {0.0, 1.0}, "share of the cups that draw no filling; not beside `liquid`"}};
  return fields;
}

}  // namespace

ClutterSpec clutter_spec_from_json(const JsonReader& json) {
  ClutterSpec spec;
  spec.source = json.value();
  spec.file = json.file();
  read_fields(json,
              std::tuple{FieldsOf<ClutterSpec>{clutter_fields(), spec}, FieldsOf<ClutterSpec>{thing_fields(), spec}});
  if (spec.touching + spec.occluding > 1.0) json.fail_at("occluding", "must leave touching + occluding at most 1");
  return spec;
}

std::vector<KeyRow> thing_keys() { return key_rows(thing_fields(), ClutterSpec{}); }

std::vector<KeyTable> thing_key_tables() {
  const ClutterSpec standard;
  return {{"cups", "cups", "Cups", key_rows(cups_fields(), standard)},
          {"objects", "objects", "Other things", key_rows(objects_fields(), standard)},
          {"region_mm", "region", "Where they stand", key_rows(region_fields(), Eigen::AlignedBox2d())}};
}

std::vector<KeyTable> clutter_key_tables() {
  std::vector<KeyRow> rows = key_rows(clutter_fields(), ClutterSpec{});
  std::ranges::move(thing_keys(), std::back_inserter(rows));
  std::vector<KeyTable> tables = thing_key_tables();
  tables.insert(tables.begin(), {"", "", "What stands on random desks", std::move(rows)});
  return tables;
}

ClutterSpec read_clutter_spec(const std::filesystem::path& path) {
  const Json json = read_json(path);
  return clutter_spec_from_json(JsonReader(json, path.string()));
}

}  // namespace fathom
