#include "datasets/dataset_spec.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.h"
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

double drawn(Rng& rng, const Interval2& interval) {
  return rounded(interval.low + (interval.high - interval.low) * rng.uniform());
}

/// One number, or the ends of what is drawn.
Interval2 interval_from_json(const JsonReader& json, Range range) {
  if (json.value().is_number()) return {json.number(range), json.number(range)};
  const std::vector<double> ends = json.numbers(range);
  if (ends.size() != 2) json.fail("must be a number, or the least and the largest of what is drawn");
  if (ends[1] < ends[0]) json.fail("must not end below its start");
  return {ends[0], ends[1]};
}

void read_interval(const JsonReader& json, const char* key, Range range, Interval2& interval) {
  if (json.has(key)) interval = interval_from_json(json.at(key), range);
}

void read_view(const JsonReader& json, DatasetSpec& spec) {
  json.allow_only({"models", "units", "height_mm", "aim_x_mm", "aim_y_mm", "roll_deg"});
  if (json.has("models"))
    for (const JsonReader& model : json.at("models").items()) {
      const Json alone = {{"model", model.text()}, {"height_mm", 650}, {"pitch_deg", 60}};
      spec.rigs.push_back(rig_from_json(JsonReader(alone, model.file(), model.pointer())));
      spec.sensors.push_back(model.text());
    }
  if (spec.sensors.empty()) json.fail_at("models", "must name at least one sensor model");
  spec.units = json.integer_or("units", spec.units, 1, 1 << 30);
  read_interval(json, "height_mm", {300.0, 3000.0}, spec.height_mm);
  read_interval(json, "aim_x_mm", {-1e4, 1e4}, spec.aim_x_mm);
  read_interval(json, "aim_y_mm", {0.0, 1e4}, spec.aim_y_mm);
  read_interval(json, "roll_deg", {-180.0, 180.0}, spec.roll_deg);
}

/// A cup's shape with a number in place of every pair [least, largest]; walls by their thickness.
Json drawn_shape(const JsonReader& shape, Rng rng, const std::string& name) {
  Json result = {{"name", name}};
  for (const auto& [key, value] : shape.value().items())
    result[key] = value.is_array() && value.size() == 2 && value[0].is_number()
                      ? Json(drawn(rng, interval_from_json(shape.at(key), kNonNegative)))
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
  json.allow_only({"$schema", "sensor", "desk", "cups", "liquids", "fill_share", "empty", "objects", "region_mm",
                   "gap_mm", "touching", "occluding", "mode", "light"});
  DatasetSpec spec;
  spec.source = all;
  read_view(json.at("sensor"), spec);
  Json desk = Json::object();
  if (json.has("desk")) {
    json.at("desk").allow_only({"albedo", "glaze", "size_mm", "centre_mm"});
    desk = json.at("desk").value();
    read_interval(json.at("desk"), "albedo", kShare, spec.desk_albedo);
    desk["albedo"] = spec.desk_albedo.low;
  }
  for (const JsonReader& liquid : json.items_or_none("liquids")) {
    const Medium medium = medium_from_json(liquid);  // a mistake shows before the first frame
    for (const Rig& rig : spec.rigs) require_index(liquid, medium, rig.sensor.wavelength_nm);
    spec.liquids.push_back(liquid.value());
  }
  read_interval(json, "fill_share", kShare, spec.fill_share);
  spec.empty = json.number_or("empty", spec.empty, kShare);
  if (spec.liquids.empty() && spec.empty < 1.0) json.fail_at("liquids", "must hold at least one, unless empty is 1");
  const std::array<std::string, 2> modes{"geometric", "photometric"};
  const std::array<std::string, 3> lights{"direct", "full", "auto"};
  if (json.has("mode"))
    spec.mode = json.at("mode").choice(modes, "mode") == 0 ? CaptureMode::geometric : CaptureMode::photometric;
  if (spec.mode == CaptureMode::photometric && !json.has("light")) spec.source["light"] = "auto";
  if (json.has("light")) {
    const std::size_t light = json.at("light").choice(lights, "light");
    if (lights[light] != "auto") spec.light = lights[light] == "full" ? LightModel::full : LightModel::direct;
  }
  if (spec.light == LightModel::full && spec.mode == CaptureMode::geometric)
    json.fail_at("light", "full needs \"mode\": \"photometric\": geometric frames know direct light only");

  json.at("cups").allow_only({"number", "kinds"});
  Json clutter = {{"sensor", {{"model", spec.sensors[0]}, {"height_mm", 650}, {"aim_mm", {0, 350, 0}}}},
                  {"desk", desk}};
  clutter["cups"] = json.at("cups").value();
  clutter["cups"]["kinds"] = drawn_kinds(json.at("cups"), seed);
  for (const char* key : {"objects", "region_mm", "gap_mm", "touching", "occluding"})
    if (json.has(key)) clutter[key] = json.at(key).value();
  spec.clutter = clutter_spec_from_json(JsonReader(clutter, file));
  return spec;
}

Json dataset_scene(const DatasetSpec& spec, std::uint64_t seed, std::uint64_t frame) {
  Rng view(seed, Draw::view, frame);
  ClutterSpec clutter = spec.clutter;
  const std::string& model = spec.sensors[view.below(static_cast<std::uint32_t>(spec.sensors.size()))];
  const double height = drawn(view, spec.height_mm), x = drawn(view, spec.aim_x_mm), y = drawn(view, spec.aim_y_mm);
  clutter.sensor = {{"model", model},
                    {"height_mm", height},
                    {"aim_mm", {x, y, 0.0}},
                    {"roll_deg", drawn(view, spec.roll_deg)},
                    {"unit", {{"serial", 1 + view.below(static_cast<std::uint32_t>(spec.units))}}}};
  clutter.desk["albedo"] = drawn(view, spec.desk_albedo);
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
