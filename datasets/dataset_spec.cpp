#include "datasets/dataset_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/fields.h"
#include "core/files.h"
#include "core/rng.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/medium_json.h"

namespace fathom {
namespace {

/// What randomness is for, so that no two uses share a stream.
enum class Draw : std::uint64_t { shape = 1, view = 2, fill = 3 };

constexpr Range kShare{0.0, 1.0};

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

double drawn(Rng& rng, const Interval& interval) {
  return rounded(interval.low + (interval.high - interval.low) * rng.uniform());
}

std::span<const Field<DatasetSpec>> sensor_fields() {
  using Spec = DatasetSpec;
  static const Field<Spec> fields[] = {
      {"models",
       Part<Spec>{[](const JsonReader& json, Spec& spec) {
                    for (const JsonReader& model : json.items()) {
                      const Json alone = {{"model", model.text()}, {"height_mm", 650}, {"pitch_deg", 60}};
                      spec.rigs.push_back(rig_from_json(JsonReader(alone, model.file(), model.pointer())));
                      spec.sensors.push_back(model.text());
                    }
                    if (spec.sensors.empty()) json.fail("must name at least one sensor model");
                  },
                  nullptr, R"({"type": "array", "items": {"type": "string"}, "minItems": 1})", "a list of names"},
       {},
       "names of `fathom list sensors`, of which each frame draws one",
       true},
      {"units",
       &Spec::units,
       {1.0, 1 << 30},
       "serial numbers are drawn from 1 to this; each unit has errors of its own"},
      {"height_mm", &Spec::height_mm, {300.0, 3000.0}, "of the baseline's middle above the desk"},
      {"aim_x_mm", &Spec::aim_x_mm, {-1e4, 1e4}, "point of the desk that it looks at, to the sensor's right"},
      {"aim_y_mm", &Spec::aim_y_mm, {0.0, 1e4}, "the same, away from the sensor"},
      {"roll_deg", &Spec::roll_deg, {-180.0, 180.0}, "turn about the optical axis"}};
  return fields;
}

std::span<const Field<DatasetSpec>> desk_fields() {
  using Spec = DatasetSpec;
  const auto as_in_a_scene = [](std::string_view schema, std::string_view allowed) {
    return Part<Spec>{nullptr, nullptr, schema, allowed};
  };
  static const Field<Spec> fields[] = {
      {"albedo", &Spec::desk_albedo, kShare, "how bright the desk is in infrared light"},
      {"glaze", as_in_a_scene("../schema.json#/$defs/glaze", "an object"), {}, "as in a scene"},
      {"size_mm", as_in_a_scene("../schema.json#/$defs/size2", "two lengths above 0"), {}, "as in a scene"},
      {"centre_mm", as_in_a_scene("../schema.json#/$defs/place2", "[x, y]"), {}, "as in a scene"}};
  return fields;
}

void read_liquids(const JsonReader& json, DatasetSpec& spec) {
  for (const JsonReader& liquid : json.items()) {
    const Medium medium = medium_from_json(liquid);  // a mistake shows before the first frame
    for (const Rig& rig : spec.rigs) require_index(liquid, medium, rig.sensor.wavelength_nm);
    spec.liquids.push_back(liquid.value());
  }
}

std::span<const Field<DatasetSpec>> spec_fields() {
  using Spec = DatasetSpec;
  static const Field<Spec> fields[] = {
      schema_field<Spec>(),
      {"sensor",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { read_fields(json, sensor_fields(), spec); }, nullptr,
                  "#/$defs/sensor", "an object"},
       {},
       "which sensors, and where they stand",
       true},
      {"desk",
       Part<Spec>{[](const JsonReader& json, Spec& spec) { read_fields(json, desk_fields(), spec); }, nullptr,
                  "#/$defs/desk", "an object"},
       {},
       "what things stand on"},
      {"liquids", Part<Spec>{read_liquids, nullptr, "#/$defs/liquids", "a list"}, {}, "what is poured, as in a scene"},
      {"fill_share", &Spec::fill_share, kShare, "of the cup's depth to which it is poured"},
      {"empty", &Spec::empty, kShare, "share of the cups that hold nothing"},
      {"mode",
       enum_choice<&Spec::mode, Spec>({"geometric", "photometric"}),
       {},
       "geometric: exact refraction and the noise of measured desks, cheap; photometric: infrared images, matched"},
      {"light",
       Choice<Spec>{light_names(),
                    [](const Spec& spec) {
                      return !spec.light ? std::size_t{0} : *spec.light == LightModel::direct ? 1 : 2;
                    },
                    [](Spec& spec, std::size_t choice) { spec.light = light_named(light_names()[choice]); }},
       {},
       "direct: liquids that scatter are opaque; full: also what is scattered in liquids, mirrored and interreflected, "
       "of photometric frames; auto: full, unless a liquid scatters as paint does (reduced scattering from 20 per mm); "
       "geometric frames add only what is scattered"}};
  return fields;
}

/// A cup's shape with a number in place of every pair [least, largest]; walls by their thickness.
Json drawn_shape(const JsonReader& shape, Rng rng, const std::string& name) {
  Json result = {{"name", name}};
  for (const auto& [key, value] : shape.value().items())
    result[key] = value.is_array() && value.size() == 2 && value[0].is_number()
                      ? Json(drawn(rng, shape.at(key).interval(kNonNegative)))
                      : value;
  if (!result.contains("wall_mm")) return result;
  if (result.contains("outer_radius_mm")) shape.fail_at("wall_mm", "cannot stand beside outer_radius_mm");
  const JsonReader lengths(result, shape.file(), shape.pointer());
  result["outer_radius_mm"] =
      rounded(lengths.number("inner_radius_mm", kPositive) + lengths.number("wall_mm", kPositive));
  result.erase("wall_mm");
  return result;
}

/// Depth [mm] of a kind of cups. Throws Error where `kind` stands.
double depth_mm(const Json& entry, const JsonReader& kind) {
  if (!entry.is_object()) kind.fail("must be an object");
  for (const char* key : {"position_mm", "yaw_deg", "liquid", "fill_mm", "fill_ml", "surface"})
    if (entry.contains(key)) kind.fail_at(key, "cannot stand here");
  Json filled = entry;
  filled["position_mm"] = {0.0, 0.0};
  filled["liquid"] = "water";
  filled["fill_mm"] = 1.0;
  return mm_from_metres(cup_depth(cup_from_json(JsonReader(filled, kind.file(), kind.pointer()))));
}

/// The kinds of cups, those with ranges drawn as often as their `variants` say.
Json drawn_kinds(const JsonReader& cups, std::uint64_t seed) {
  constexpr int kMostVariants = 1000;
  Json result = Json::array();
  const std::vector<JsonReader> kinds = cups.at("kinds").items();
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    Json entry = kinds[kind].value();
    if (!entry.is_object() || !entry.contains("variants")) {
      depth_mm(entry, kinds[kind]);
      result.push_back(std::move(entry));
      continue;
    }
    const int variants = kinds[kind].at("variants").integer(1, kMostVariants);
    entry.erase("variants");
    const JsonReader shape = kinds[kind].at("shape");
    if (!shape.value().is_object()) shape.fail("must be an object where there are variants");
    for (int variant = 0; variant < variants; ++variant) {
      entry["shape"] =
          drawn_shape(shape, Rng(seed, Draw::shape, kind, variant), fmt::format("cup_{}_{}", kind, variant));
      depth_mm(entry, kinds[kind]);
      result.push_back(entry);
    }
  }
  return result;
}

/// The file's keys over those of the shipped specification, those of its objects as well.
Json with_defaults(const Json& given, const std::string& file) {
  if (!given.is_object()) throw Error(file, "/", "must be an object");
  Json result = read_json(shipped_dataset_spec());
  for (const auto& [key, value] : given.items()) {
    if (!value.is_object() || !result.contains(key)) {
      result[key] = value;
      continue;
    }
    for (const auto& [inner, content] : value.items()) result[key][inner] = content;
  }
  return result;
}

}  // namespace

std::filesystem::path shipped_dataset_spec() { return data_directory() / "datasets" / "cups.json"; }

DatasetSpec read_dataset_spec(const std::filesystem::path& path, std::uint64_t seed) {
  return dataset_spec_from_json(read_json(path), path.string(), seed);
}

DatasetSpec dataset_spec_from_json(const Json& given, const std::string& file, std::uint64_t seed) {
  const Json all = with_defaults(given, file);
  const JsonReader json(all, file);
  const std::vector<KeyRow> things = thing_keys();
  std::vector<std::string_view> of_things;
  for (const KeyRow& row : things) of_things.push_back(row.key);
  DatasetSpec spec;
  spec.source = all;
  read_fields(json, spec_fields(), spec, of_things);
  if (spec.liquids.empty() && spec.empty < 1.0) json.fail_at("liquids", "must hold at least one, unless empty is 1");
  if (spec.mode == CaptureMode::photometric && !json.has("light")) spec.source["light"] = "auto";
  if (spec.light == LightModel::full && spec.mode == CaptureMode::geometric)
    json.fail_at("light",
                 "full needs \"mode\": \"photometric\": geometric frames know direct light and what liquids scatter");

  Json desk = json.has("desk") ? json.at("desk").value() : Json::object();
  if (desk.contains("albedo")) desk["albedo"] = spec.desk_albedo.low;
  Json clutter = {{"sensor", {{"model", spec.sensors[0]}, {"height_mm", 650}, {"aim_mm", {0, 350, 0}}}},
                  {"desk", desk}};
  for (const KeyRow& row : things)
    if (json.has(row.key)) clutter[row.key] = json.at(row.key).value();
  clutter["cups"]["kinds"] = drawn_kinds(json.at("cups"), seed);
  spec.clutter = clutter_spec_from_json(JsonReader(clutter, file));
  return spec;
}

std::vector<KeyTable> dataset_key_tables() {
  const DatasetSpec standard;
  std::vector<KeyRow> rows = key_rows(spec_fields(), standard);
  std::ranges::move(thing_keys(), std::back_inserter(rows));
  std::vector<KeyTable> tables{{"", "", "The data set", std::move(rows)},
                               {"sensor", "sensor", "Sensors", key_rows(sensor_fields(), standard)},
                               {"desk", "desk", "Desk", key_rows(desk_fields(), standard)}};
  std::ranges::move(thing_key_tables(), std::back_inserter(tables));
  const Json shipped = read_json(shipped_dataset_spec());
  for (KeyTable& table : tables) {
    const Json& values = table.place.empty() ? shipped : shipped.at(table.place);
    for (KeyRow& row : table.rows)
      if (values.contains(row.key)) row.standard = values[row.key], row.is_required = false;
  }
  return tables;
}

Json dataset_scene(const DatasetSpec& spec, std::uint64_t seed, std::uint64_t frame) {
  Rng view(seed, Draw::view, frame);
  ClutterSpec clutter = spec.clutter;
  const std::string& model = spec.sensors[view.below(static_cast<std::uint32_t>(spec.sensors.size()))];
  const double height = drawn(view, spec.height_mm), x = drawn(view, spec.aim_x_mm), y = drawn(view, spec.aim_y_mm);
  clutter.sensor = Json{{"model", model},
                        {"height_mm", height},
                        {"aim_mm", {x, y, 0.0}},
                        {"roll_deg", drawn(view, spec.roll_deg)},
                        {"unit", {{"serial", 1 + view.below(static_cast<std::uint32_t>(spec.units))}}}};
  Json desk = clutter.desk;
  desk["albedo"] = drawn(view, spec.desk_albedo);
  clutter.desk = std::move(desk);
  Json scene = random_scene(clutter, seed, frame);
  Rng fill(seed, Draw::fill, frame);
  for (Json& cup : scene["cups"]) {
    const bool is_empty = fill.uniform() < spec.empty;
    const double share = fill.uniform();
    const std::uint32_t which = spec.liquids.empty() ? 0 : fill.below(static_cast<std::uint32_t>(spec.liquids.size()));
    if (is_empty || spec.liquids.empty()) continue;
    Json empty = cup;
    for (const char* key : {"position_mm", "yaw_deg"}) empty.erase(key);
    const double deep = depth_mm(empty, JsonReader(empty, clutter.file, fmt::format("frame {}", frame)));
    const double fill_mm = rounded(deep * (spec.fill_share.low + share * (spec.fill_share.high - spec.fill_share.low)));
    if (fill_mm < 0.1) continue;
    cup["liquid"] = spec.liquids[which];
    cup["fill_mm"] = std::min(fill_mm, deep);
  }
  return scene;
}

}  // namespace fathom
