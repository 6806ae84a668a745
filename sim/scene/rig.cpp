#include "sim/scene/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/image_file.h"
#include "core/input_policy.h"
#include "core/lengths.h"
#include "core/units.h"
#include "sim/scene/library.h"

namespace fathom {
namespace {

constexpr std::uint64_t kBytesPerPosition = 16;  // of a pattern: its brightness, sharp and blurred

/// A grey PNG, a pixel for each position of the grid; relative to the file that names it.
void read_pattern_image(const JsonReader& json, PatternModel& pattern) {
  pattern.image_file = path_named_in(json.file(), json.pointer(), json.text()).string();
  const Image<std::uint16_t> grey = read_png_grey(pattern.image_file);
  require_within_limit(pattern.image_file, "", bytes_of({grey.size(), kBytesPerPosition}), "positions");
  const std::uint16_t brightest = *std::max_element(grey.pixels().begin(), grey.pixels().end());
  if (brightest == 0) json.fail("is black all over; a pattern needs bright pixels");
  if (grey.width() < 16 || grey.height() < 16) json.fail("must have at least 16 × 16 pixels");
  Image<float> brightness(grey.width(), grey.height());
  std::transform(grey.pixels().begin(), grey.pixels().end(), brightness.pixels().begin(),
                 [&](std::uint16_t value) { return static_cast<float>(value) / static_cast<float>(brightest); });
  pattern.image = std::make_shared<const Image<float>>(std::move(brightness));
}

void read_pattern(const JsonReader& json, PatternModel& pattern) {
  json.allow_only({"tile_columns", "tile_rows", "tiles_across", "tiles_down", "step_px", "dots_per_tile",
                   "dot_sigma_ir_px", "zero_order", "tile_spread", "image", "seed"});
  pattern.tile_columns = json.integer_or("tile_columns", pattern.tile_columns, 16, 512);
  pattern.tile_rows = json.integer_or("tile_rows", pattern.tile_rows, 16, 512);
  pattern.tiles_across = json.integer_or("tiles_across", pattern.tiles_across, 1, 64);
  pattern.tiles_down = json.integer_or("tiles_down", pattern.tiles_down, 1, 64);
  require_within_limit(
      json.file(), json.pointer(),
      bytes_of({static_cast<std::uint64_t>(pattern.tile_columns * pattern.tile_rows),
                static_cast<std::uint64_t>(pattern.tiles_across * pattern.tiles_down), kBytesPerPosition}),
      "positions");
  pattern.step_px = json.number_or("step_px", pattern.step_px, {0.25, 16.0});
  const int positions = pattern.tile_columns * pattern.tile_rows;
  // Dots keep a distance of 2 positions, so random placement fills at most about 0.18 of the grid; below 0.09 windows
  // hold too few dots to be told apart.
  pattern.dots_per_tile =
      json.integer_or("dots_per_tile", pattern.dots_per_tile, positions * 9 / 100, positions * 15 / 100);
  pattern.dot_sigma_ir_px = json.number_or("dot_sigma_ir_px", pattern.dot_sigma_ir_px, {0.3, 2.0});
  // A dot is drawn from the positions at most 1 to 2 steps away; a wider one would be cut where it is still bright.
  const double widest_ir_px = 1.2 * pattern.step_px;
  if (pattern.dot_sigma_ir_px > widest_ir_px)
    json.fail_at("dot_sigma_ir_px", fmt::format("must be at most 1.2 step_px, here {:g}", widest_ir_px));
  pattern.zero_order = json.number_or("zero_order", pattern.zero_order, {0.0, 1000.0});
  pattern.tile_spread = json.number_or("tile_spread", pattern.tile_spread, {0.0, 0.3});
  if (json.has("image")) read_pattern_image(json.at("image"), pattern);
  pattern.seed = static_cast<std::uint64_t>(json.integer_or("seed", static_cast<int>(pattern.seed), 0, 1 << 30));
}

void read_matcher(const JsonReader& json, MatcherModel& matcher) {
  json.allow_only({"method", "window_columns", "window_rows", "disparity_min_px", "disparity_max_px", "correlation_min",
                   "contrast_min_dn", "relative_contrast_min", "compression_dn", "hole_max_px"});
  if (json.has("method")) {
    const std::string choices[] = {"precise", "device"};
    matcher.method = MatchMethod{static_cast<int>(json.at("method").choice(choices, "matching method"))};
  }
  matcher.window_columns = json.integer_or("window_columns", matcher.window_columns, 3, 31);
  matcher.window_rows = json.integer_or("window_rows", matcher.window_rows, 3, 31);
  if (matcher.window_columns % 2 == 0) json.fail_at("window_columns", "must be odd");
  if (matcher.window_rows % 2 == 0) json.fail_at("window_rows", "must be odd");
  matcher.disparity_min_px = json.integer_or("disparity_min_px", matcher.disparity_min_px, -256, 255);
  matcher.disparity_max_px = json.integer_or("disparity_max_px", matcher.disparity_max_px, -255, 256);
  if (matcher.disparity_max_px <= matcher.disparity_min_px)
    json.fail_at("disparity_max_px", "must be above disparity_min_px");
  matcher.correlation_min = json.number_or("correlation_min", matcher.correlation_min, {0.0, 1.0});
  matcher.contrast_min = json.number_or("contrast_min_dn", matcher.contrast_min, kNonNegative);
  matcher.relative_contrast_min = json.number_or("relative_contrast_min", matcher.relative_contrast_min, {0.0, 2.0});
  matcher.compression = json.number_or("compression_dn", matcher.compression, kNonNegative);
  matcher.hole_max_px = json.integer_or("hole_max_px", matcher.hole_max_px, 0, 64);
}

Eigen::Vector2i size_from_json(const JsonReader& json) {
  const std::vector<JsonReader> items = json.items();
  if (items.size() != 2) json.fail("must be a width and a height");
  return {items[0].integer(16, 8192), items[1].integer(16, 8192)};
}

/// Everything but the pose.
void read_model(const JsonReader& json, SensorModel& sensor) {
  sensor.baseline = json.metres_or("baseline_mm", sensor.baseline, kLengthMm);
  sensor.wavelength_nm = json.number_or("wavelength_nm", sensor.wavelength_nm, {100.0, 5000.0});
  if (json.has("ir_size_px")) {
    const Eigen::Vector2i size = size_from_json(json.at("ir_size_px"));
    sensor.ir_width = size.x(), sensor.ir_height = size.y();
  }
  if (json.has("depth_size_px")) {
    const Eigen::Vector2i size = size_from_json(json.at("depth_size_px"));
    sensor.width = size.x(), sensor.height = size.y();
    sensor.principal_px = 0.5 * size.cast<double>();
  }
  if (sensor.ir_width != 2 * sensor.width || sensor.ir_height < 2 * sensor.height ||
      (sensor.ir_height - 2 * sensor.height) % 2)
    json.fail(
        fmt::format("ir_size_px must be twice depth_size_px in width and at least twice, by an even number, in height; "
                    "got {}×{} and {}×{}",
                    sensor.ir_width, sensor.ir_height, sensor.width, sensor.height));
  constexpr std::uint64_t kBytesPerPixel = 96;  // of a photometric capture: images, speckle, reference, matcher
  require_within_limit(json.file(), json.pointer(),
                       bytes_of({static_cast<std::uint64_t>(sensor.ir_width),
                                 static_cast<std::uint64_t>(sensor.ir_height), kBytesPerPixel}),
                       "pixels");
  sensor.focal_px = json.number_or("focal_px", sensor.focal_px, {1.0, 1e6});
  if (json.has("principal_px")) sensor.principal_px = json.at("principal_px").vector2({-1e6, 1e6});
  sensor.reference = json.metres_or("reference_mm", sensor.reference, kLengthMm);
  sensor.near = json.metres_or("near_mm", sensor.near, kLengthMm);
  sensor.far = json.metres_or("far_mm", sensor.far, kLengthMm);
  if (sensor.far <= sensor.near) json.fail_at("far_mm", "must be above near_mm");
  sensor.radiant_dn_mm2 = json.number_or("radiant_dn_mm2", sensor.radiant_dn_mm2, kPositive);
  if (json.has("noise")) sensor.noise = noise_from_json(json.at("noise"));
  if (json.has("optics")) sensor.optics = optics_from_json(json.at("optics"), sensor.optics);
  if (json.has("unit")) sensor.unit = unit_from_json(json.at("unit"), sensor.unit);
  if (json.has("pattern")) read_pattern(json.at("pattern"), sensor.pattern);
  if (json.has("matcher")) read_matcher(json.at("matcher"), sensor.matcher);
  if (json.has("quantization")) {
    const std::string choices[] = {"device", "off"};
    sensor.quantized = json.at("quantization").choice(choices, "quantization") == 0;
  }
}

Pose pose_from_json(const JsonReader& json, double baseline) {
  const double height = json.metres("height_mm", kLengthMm);
  const Eigen::Vector3d midpoint(0.0, 0.0, height);
  const double roll = radians_from_deg(json.number_or("roll_deg", 0.0, {-180.0, 180.0}));
  if (json.has("aim_mm") == json.has("pitch_deg")) json.fail("needs either aim_mm or pitch_deg beside height_mm");
  if (json.has("pitch_deg"))
    return camera_pose(midpoint, radians_from_deg(json.number("pitch_deg", {-90.0, 90.0})), 0.0, roll, baseline);
  const Eigen::Vector3d forward = json.at("aim_mm").vector3(kPlaceMm) * kMetresPerMm - midpoint;
  if (forward.norm() == 0.0) json.fail_at("aim_mm", "must not be the sensor's own place");
  const double horizontal = std::hypot(forward.x(), forward.y());
  const double yaw = horizontal > 0.0 ? std::atan2(-forward.x(), forward.y()) : 0.0;
  return camera_pose(midpoint, std::atan2(-forward.z(), horizontal), yaw, roll, baseline);
}

/// Level, to the right of the direction: the camera's x axis if it were not rolled.
Eigen::Vector3d level_right(const Eigen::Vector3d& forward) {
  const double horizontal = forward.head<2>().norm();
  if (horizontal < 1e-12) return Eigen::Vector3d::UnitX();
  return {forward.y() / horizontal, -forward.x() / horizontal, 0.0};
}

/// Pitch and roll, or the aim where the sensor looks to the side.
void add_direction(const Eigen::Matrix3d& world_from_camera, const Eigen::Vector3d& midpoint_in_world, Json& json) {
  const Eigen::Vector3d forward = world_from_camera.col(2);
  if (level_right(forward) == Eigen::Vector3d::UnitX()) {
    json["pitch_deg"] = deg_from_radians(std::atan2(-forward.z(), forward.head<2>().norm()));
  } else {
    const Eigen::Vector3d aim_mm = (midpoint_in_world + forward) / kMetresPerMm;
    json["aim_mm"] = {aim_mm.x(), aim_mm.y(), aim_mm.z()};
  }
  json["roll_deg"] = deg_from_radians(roll_of(world_from_camera));
}

}  // namespace

Pose camera_pose(const Eigen::Vector3d& midpoint_in_world, double pitch, double yaw, double roll, double baseline) {
  // Columns: the camera's right, down and forward in the world when it looks along +y.
  Eigen::Matrix3d world_from_level;
  world_from_level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  Pose world_from_camera;
  world_from_camera.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * world_from_level *
                               Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
  world_from_camera.translation() = midpoint_in_world - 0.5 * baseline * world_from_camera.linear().col(0);
  return world_from_camera;
}

double roll_of(const Eigen::Matrix3d& world_from_camera) {
  const Eigen::Vector3d right = world_from_camera.col(0), forward = world_from_camera.col(2);
  const Eigen::Vector3d level = level_right(forward);
  return std::atan2(right.dot(forward.cross(level)), right.dot(level));
}

Rig rig_from_json(const JsonReader& json) {
  json.allow_only(
      {"model",          "height_mm",     "aim_mm",   "pitch_deg",    "roll_deg",     "baseline_mm", "wavelength_nm",
       "ir_size_px",     "depth_size_px", "focal_px", "principal_px", "reference_mm", "near_mm",     "far_mm",
       "radiant_dn_mm2", "optics",        "noise",    "quantization", "pattern",      "matcher",     "unit"});
  Rig rig;
  rig.sensor.noise = basic_noise();
  rig.sensor.name.clear();  // a full description has no model's name
  if (json.has("model")) {
    const std::string name = json.text("model");
    const std::filesystem::path file =
        library_file("sensors", "sensor model", name, json.file(), json.pointer() + "/model");
    const Json text = read_json(file);
    const JsonReader model(text, file.string());
    model.allow_only({"source", "baseline_mm", "wavelength_nm", "ir_size_px", "depth_size_px", "focal_px",
                      "principal_px", "reference_mm", "near_mm", "far_mm", "radiant_dn_mm2", "optics", "noise",
                      "quantization", "pattern", "matcher", "unit"});
    read_model(model, rig.sensor);
    rig.sensor.name = name;
  }
  read_model(json, rig.sensor);
  rig.world_from_camera = pose_from_json(json, rig.sensor.baseline);
  return rig;
}

Json json_from_rig(const Rig& rig) {
  const SensorModel& s = rig.sensor;
  const Eigen::Vector3d midpoint = 0.5 * (rig.camera_in_world() + rig.projector_in_world());
  Json json = Json::object();
  if (!s.name.empty()) json["model"] = s.name;
  json["height_mm"] = mm_from_metres(midpoint.z());
  add_direction(rig.world_from_camera.linear(), midpoint, json);
  json.update({
      {"baseline_mm", mm_from_metres(s.baseline)},
      {"wavelength_nm", s.wavelength_nm},
      {"ir_size_px", {s.ir_width, s.ir_height}},
      {"depth_size_px", {s.width, s.height}},
      {"focal_px", s.focal_px},
      {"principal_px", {s.principal_px.x(), s.principal_px.y()}},
      {"reference_mm", mm_from_metres(s.reference)},
      {"near_mm", mm_from_metres(s.near)},
      {"far_mm", mm_from_metres(s.far)},
      {"radiant_dn_mm2", s.radiant_dn_mm2},
      {"quantization", s.quantized ? "device" : "off"},
      {"optics", json_from_optics(s.optics)},
      {"noise", json_from_noise(s.noise)},
      {"unit", json_from_unit(s.unit)},
      {"pattern",
       {{"tile_columns", s.pattern.tile_columns},
        {"tile_rows", s.pattern.tile_rows},
        {"tiles_across", s.pattern.tiles_across},
        {"tiles_down", s.pattern.tiles_down},
        {"step_px", s.pattern.step_px},
        {"dots_per_tile", s.pattern.dots_per_tile},
        {"dot_sigma_ir_px", s.pattern.dot_sigma_ir_px},
        {"zero_order", s.pattern.zero_order},
        {"tile_spread", s.pattern.tile_spread},
        {"seed", s.pattern.seed}}},
      {"matcher",
       {{"method", s.matcher.method == MatchMethod::device ? "device" : "precise"},
        {"window_columns", s.matcher.window_columns},
        {"window_rows", s.matcher.window_rows},
        {"disparity_min_px", s.matcher.disparity_min_px},
        {"disparity_max_px", s.matcher.disparity_max_px},
        {"correlation_min", s.matcher.correlation_min},
        {"contrast_min_dn", s.matcher.contrast_min},
        {"relative_contrast_min", s.matcher.relative_contrast_min},
        {"compression_dn", s.matcher.compression},
        {"hole_max_px", s.matcher.hole_max_px}}},
  });
  if (s.pattern.image) json["pattern"]["image"] = s.pattern.image_file;
  return json;
}

}  // namespace fathom
