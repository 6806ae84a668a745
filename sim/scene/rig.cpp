#include "sim/scene/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/image_file.h"
#include "core/input_policy.h"
#include "core/lengths.h"
#include "core/library.h"
#include "core/units.h"

namespace fathom {
namespace {

constexpr Range kFocalPx{1.0, 1e6}, kPrincipalPx{-1e6, 1e6};

constexpr std::uint64_t kBytesPerPosition = 28;  // of a pattern: the image, and of its dots what shooting takes

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

Calibration calibration_from_json(const JsonReader& json) {
  json.allow_only({"baseline_mm", "focal_px", "principal_px"});
  return {json.metres("baseline_mm", kLengthMm), json.number("focal_px", kFocalPx),
          json.at("principal_px").vector2(kPrincipalPx)};
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
  sensor.focal_px = json.number_or("focal_px", sensor.focal_px, kFocalPx);
  if (json.has("principal_px")) sensor.principal_px = json.at("principal_px").vector2(kPrincipalPx);
  sensor.reference = json.metres_or("reference_mm", sensor.reference, kLengthMm);
  sensor.near = json.metres_or("near_mm", sensor.near, kLengthMm);
  sensor.far = json.metres_or("far_mm", sensor.far, kLengthMm);
  if (sensor.far <= sensor.near) json.fail_at("far_mm", "must be above near_mm");
  sensor.radiant_dn_mm2 = json.number_or("radiant_dn_mm2", sensor.radiant_dn_mm2, kPositive);
  if (json.has("noise")) sensor.noise = noise_from_json(json.at("noise"));
  if (json.has("optics")) sensor.optics = optics_from_json(json.at("optics"), sensor.optics);
  if (json.has("unit")) sensor.unit = unit_from_json(json.at("unit"), sensor.unit);
  if (const UnitMap* map = sensor.unit.learned.map.get();
      map && (sensor.width != map->camera.width() || sensor.height != map->camera.height()))
    json.fail_at("unit", fmt::format("was learned of a depth image of {} × {} pixels, and depth_size_px is {} × {}",
                                     map->camera.width(), map->camera.height(), sensor.width, sensor.height));
  if (json.has("pattern")) read_pattern(json.at("pattern"), sensor.pattern);
  if (json.has("matcher")) read_matcher(json.at("matcher"), sensor.matcher);
  if (json.has("quantization")) {
    const std::string choices[] = {"device", "off"};
    sensor.quantized = json.at("quantization").choice(choices, "quantization") == 0;
  }
  sensor.step_phase = json.number_or("depth_step_phase", sensor.step_phase, {-2.0, 2.0});
  sensor.codes_per_step = json.integer_or("codes_per_step", sensor.codes_per_step, 1, 64);
  sensor.cut = json.metres_or("depth_cut_mm", sensor.cut, {0.0, 100.0});
  if (json.has("believed")) sensor.believed = calibration_from_json(json.at("believed"));
}

/// Four rows of four numbers, as run.json has them: a turn and a place [m].
Pose pose_from_rows(const JsonReader& json) {
  constexpr double kRight = 1e-9;  // rounding of numbers that were written down
  const std::vector<JsonReader> rows = json.items();
  if (rows.size() != 4) json.fail("must be 4 rows of 4 numbers");
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 4; ++i) {
    const std::vector<double> row = rows[i].numbers();
    if (row.size() != 4) rows[i].fail("must be 4 numbers");
    matrix.row(i) = Eigen::RowVector4d::Map(row.data());
  }
  const Eigen::Matrix3d turn = matrix.topLeftCorner<3, 3>();
  if (!(turn * turn.transpose()).isIdentity(kRight) || turn.determinant() < 0.0)
    json.fail("must turn without stretching or mirroring: three rows at right angles, of length 1");
  if (matrix.topRightCorner<3, 1>().cwiseAbs().maxCoeff() > metres_from_mm(kPlaceMm.high))
    json.fail(fmt::format("must place the camera within {:g} m", metres_from_mm(kPlaceMm.high)));
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) rows[3].fail("must be 0, 0, 0, 1");
  return Pose(matrix);
}

Pose pose_from_json(const JsonReader& json, double baseline) {
  if (json.has("world_from_camera")) {
    for (const char* key : {"height_mm", "aim_mm", "pitch_deg", "roll_deg"})
      if (json.has(key)) json.fail_at(key, "cannot stand beside world_from_camera, which already says it");
    return pose_from_rows(json.at("world_from_camera"));
  }
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

/// The number of millimetres that reads back as this length, where there is one: of forty-four lengths one lies between
/// those that millimetres of double precision can say.
double mm_that_read_back(double metres) {
  const double mm = mm_from_metres(metres), infinite = std::numeric_limits<double>::infinity();
  for (const double near : {mm, std::nextafter(mm, infinite), std::nextafter(mm, -infinite)})
    if (metres_from_mm(near) == metres) return near;
  return mm;
}

Json json_from_calibration(const Calibration& calibration) {
  const auto& [baseline, focal_px, principal_px] = calibration;
  return {{"baseline_mm", mm_that_read_back(baseline)},
          {"focal_px", focal_px},
          {"principal_px", {principal_px.x(), principal_px.y()}}};
}

/// All but the image. A new member does not compile until it is here or left out.
auto numbers_of(const PatternModel& pattern) {
  const auto& [tile_columns, tile_rows, tiles_across, tiles_down, step_px, dots_per_tile, dot_sigma_ir_px, zero_order,
               tile_spread, seed, image, image_file] = pattern;
  return std::tie(tile_columns, tile_rows, tiles_across, tiles_down, step_px, dots_per_tile, dot_sigma_ir_px,
                  zero_order, tile_spread, seed);
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

bool PatternModel::operator==(const PatternModel& other) const {
  if (numbers_of(*this) != numbers_of(other) || (image == nullptr) != (other.image == nullptr)) return false;
  return image == other.image ||
         (image->width() == other.image->width() && std::ranges::equal(image->pixels(), other.image->pixels()));
}

Json json_from_pose(const Pose& pose) {
  Json rows = Json::array();
  for (int i = 0; i < 4; ++i) rows.push_back({pose(i, 0), pose(i, 1), pose(i, 2), pose(i, 3)});
  return rows;
}

Rig rig_from_json(const JsonReader& json) {
  json.allow_only({"model",
                   "name",
                   "height_mm",
                   "aim_mm",
                   "pitch_deg",
                   "roll_deg",
                   "world_from_camera",
                   "baseline_mm",
                   "wavelength_nm",
                   "ir_size_px",
                   "depth_size_px",
                   "focal_px",
                   "principal_px",
                   "reference_mm",
                   "near_mm",
                   "far_mm",
                   "radiant_dn_mm2",
                   "optics",
                   "noise",
                   "quantization",
                   "depth_step_phase",
                   "codes_per_step",
                   "depth_cut_mm",
                   "believed",
                   "pattern",
                   "matcher",
                   "unit"});
  Rig rig;
  rig.sensor.noise = basic_noise();
  rig.sensor.name = json.text_or("name", "");  // of a full description
  if (json.has("model")) {
    if (json.has("name")) json.fail_at("name", "cannot stand beside model, which already says it");
    const std::string name = json.text("model");
    const std::filesystem::path file =
        library_file("sensors", "sensor model", name, json.file(), json.pointer() + "/model");
    const Json text = read_json(file);
    const JsonReader model(text, file.string());
    model.allow_only({"source",        "baseline_mm",  "wavelength_nm",    "ir_size_px",
                      "depth_size_px", "focal_px",     "principal_px",     "reference_mm",
                      "near_mm",       "far_mm",       "radiant_dn_mm2",   "optics",
                      "noise",         "quantization", "depth_step_phase", "codes_per_step",
                      "depth_cut_mm",  "believed",     "pattern",          "matcher",
                      "unit"});
    read_model(model, rig.sensor);
    rig.sensor.name = name;
  }
  read_model(json, rig.sensor);
  rig.world_from_camera = pose_from_json(json, rig.sensor.baseline);
  return rig;
}

Json json_from_rig(const Rig& rig) {
  const auto& [name, baseline, wavelength_nm, ir_width, ir_height, width, height, focal_px, principal_px, reference,
               near, far, radiant_dn_mm2, quantized, step_phase, codes_per_step, cut, pattern, optics, noise, matcher,
               unit, believed] = rig.sensor;
  Json json = Json::object();
  if (!name.empty()) json["name"] = name;
  json.update({
      {"world_from_camera", json_from_pose(rig.world_from_camera)},
      {"baseline_mm", mm_that_read_back(baseline)},
      {"wavelength_nm", wavelength_nm},
      {"ir_size_px", {ir_width, ir_height}},
      {"depth_size_px", {width, height}},
      {"focal_px", focal_px},
      {"principal_px", {principal_px.x(), principal_px.y()}},
      {"reference_mm", mm_that_read_back(reference)},
      {"near_mm", mm_that_read_back(near)},
      {"far_mm", mm_that_read_back(far)},
      {"radiant_dn_mm2", radiant_dn_mm2},
      {"quantization", quantized ? "device" : "off"},
      {"depth_step_phase", step_phase},
      {"codes_per_step", codes_per_step},
      {"depth_cut_mm", mm_that_read_back(cut)},
      {"optics", json_from_optics(optics)},
      {"noise", json_from_noise(noise)},
      {"unit", json_from_unit(unit)},
      {"pattern",
       {{"tile_columns", pattern.tile_columns},
        {"tile_rows", pattern.tile_rows},
        {"tiles_across", pattern.tiles_across},
        {"tiles_down", pattern.tiles_down},
        {"step_px", pattern.step_px},
        {"dots_per_tile", pattern.dots_per_tile},
        {"dot_sigma_ir_px", pattern.dot_sigma_ir_px},
        {"zero_order", pattern.zero_order},
        {"tile_spread", pattern.tile_spread},
        {"seed", pattern.seed}}},
      {"matcher",
       {{"method", matcher.method == MatchMethod::device ? "device" : "precise"},
        {"window_columns", matcher.window_columns},
        {"window_rows", matcher.window_rows},
        {"disparity_min_px", matcher.disparity_min_px},
        {"disparity_max_px", matcher.disparity_max_px},
        {"correlation_min", matcher.correlation_min},
        {"contrast_min_dn", matcher.contrast_min},
        {"relative_contrast_min", matcher.relative_contrast_min},
        {"compression_dn", matcher.compression},
        {"hole_max_px", matcher.hole_max_px}}},
  });
  if (believed) json["believed"] = json_from_calibration(*believed);
  if (pattern.image) json["pattern"]["image"] = pattern.image_file;
  return json;
}

}  // namespace fathom
