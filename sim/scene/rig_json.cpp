// What stands under "sensor" in a scene file: its keys as tables, and the pose.
#include "sim/scene/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fields.h"
#include "core/image_file.h"
#include "core/input_policy.h"
#include "core/library.h"
#include "core/range.h"
#include "core/units.h"

namespace fathom {
namespace {

constexpr Range kFocalPx{1.0, 1e6}, kPrincipalPx{-1e6, 1e6}, kPitchDeg{-90.0, 90.0}, kRollDeg{-180.0, 180.0};

constexpr std::uint64_t kBytesPerPosition = 28;  // of a pattern: the image, and of its dots what shooting takes

/// A grey PNG, a pixel for each position of the grid; relative to the file that names it.
PatternImage pattern_image_from_json(const JsonReader& json) {
  PatternImage image{.brightness = nullptr, .file = path_named_in(json.file(), json.pointer(), json.text()).string()};
  const Image<std::uint16_t> grey = read_png_grey(image.file);
  require_within_limit(image.file, "", bytes_of({grey.size(), kBytesPerPosition}), "positions");
  const std::uint16_t brightest = *std::max_element(grey.pixels().begin(), grey.pixels().end());
  if (brightest == 0) json.fail("is black all over; a pattern needs bright pixels");
  if (grey.width() < 16 || grey.height() < 16) json.fail("must have at least 16 × 16 pixels");
  Image<float> brightness(grey.width(), grey.height());
  std::transform(grey.pixels().begin(), grey.pixels().end(), brightness.pixels().begin(),
                 [&](std::uint16_t value) { return static_cast<float>(value) / static_cast<float>(brightest); });
  image.brightness = std::make_shared<const Image<float>>(std::move(brightness));
  return image;
}

std::span<const Field<PatternModel>> pattern_fields() {
  constexpr Range kTile{16.0, 512.0}, kTiles{1.0, 64.0};
  static const Field<PatternModel> fields[] = {
      {"tile_columns", &PatternModel::tile_columns, kTile, "positions along a tile's rows"},
      {"tile_rows", &PatternModel::tile_rows, kTile, "positions along a tile's columns"},
      {"tiles_across", &PatternModel::tiles_across, kTiles, "tiles side by side"},
      {"tiles_down", &PatternModel::tiles_down, kTiles, "tiles one below the other"},
      {"step_px", &PatternModel::step_px, {0.25, 16.0}, "angle between positions, in pixels of the depth image"},
      {"dots_per_tile",
       &PatternModel::dots_per_tile,
       {1.0, 39321.0},
       "positions of a tile that have a dot: 9 to 15 % of them"},
      {"dot_sigma_ir_px",
       &PatternModel::dot_sigma_ir_px,
       {0.3, 2.0},
       "standard deviation of a dot's image, lens included; at most 1.2 `step_px`"},
      {"zero_order",
       &PatternModel::zero_order,
       {0.0, 1000.0},
       "brightness of the spot in each tile's middle over that of a dot"},
      {"tile_spread",
       &PatternModel::tile_spread,
       {0.0, 0.3},
       "standard deviation of the tiles' brightness over their mean"},
      {"seed", &PatternModel::seed, {0.0, 1 << 30}, "by which dots are placed"},
      {"image",
       Part<PatternModel>{
           [](const JsonReader& json, PatternModel& pattern) { pattern.image = pattern_image_from_json(json); },
           [](const PatternModel& pattern) { return pattern.image.brightness ? Json(pattern.image.file) : Json(); },
           R"({"type": "string"})", "a path"},
       "a grey PNG of one's own pattern, relative to this file: a pixel for each position, instead of dots of our "
       "own"}};
  return fields;
}

void read_pattern(const JsonReader& json, PatternModel& pattern) {
  read_fields(json, pattern_fields(), pattern);
  require_within_limit(
      json.file(), json.pointer(),
      bytes_of({static_cast<std::uint64_t>(pattern.tile_columns * pattern.tile_rows),
                static_cast<std::uint64_t>(pattern.tiles_across * pattern.tiles_down), kBytesPerPosition}),
      "positions");
  // Dots keep a distance of 2 positions, so random placement fills at most about 0.18 of the grid; below 0.09 windows
  // hold too few dots to be told apart.
  const int positions = pattern.tile_columns * pattern.tile_rows;
  if (json.has("dots_per_tile")) json.at("dots_per_tile").integer(positions * 9 / 100, positions * 15 / 100);
  // A dot is drawn from the positions at most 1 to 2 steps away; a wider one would be cut where it is still bright.
  const double widest_ir_px = 1.2 * pattern.step_px;
  if (pattern.dot_sigma_ir_px > widest_ir_px)
    json.fail_at("dot_sigma_ir_px", fmt::format("must be at most 1.2 step_px, here {:g}", widest_ir_px));
}

std::span<const Field<MatcherModel>> matcher_fields() {
  constexpr Range kWindow{3.0, 31.0};
  static const Field<MatcherModel> fields[] = {
      {"method", enum_choice<&MatcherModel::method, MatcherModel>({"precise", "device"}),
       "precise: slopes and edges are followed; device: block correlation in steps of 1/8 px"},
      {"window_columns", &MatcherModel::window_columns, kWindow, "of the block, odd"},
      {"window_rows", &MatcherModel::window_rows, kWindow, "of the block, odd"},
      {"disparity_min_px",
       &MatcherModel::disparity_min_px,
       {-256.0, 255.0},
       "least disparity of the search, from the reference plane; positive: nearer"},
      {"disparity_max_px", &MatcherModel::disparity_max_px, {-255.0, 256.0}, "largest disparity of the search"},
      {"correlation_min",
       &MatcherModel::correlation_min,
       {0.0, 1.0},
       "least zero-mean normalised cross-correlation of a match"},
      {"contrast_min_dn", &MatcherModel::contrast_min, kNonNegative, "least standard deviation of a block"},
      {"relative_contrast_min",
       &MatcherModel::relative_contrast_min,
       {0.0, 2.0},
       "least ratio of standard deviation to mean in a block; device method only: light that is even, from outside or "
       "smeared within a body, takes the dots' contrast"},
      {"compression_dn", &MatcherModel::compression, kNonNegative,
       "blocks are compared after √(light + this), so that bright dots count for less; 0: after nothing; "
       "device method only"},
      {"hole_max_px",
       &MatcherModel::hole_max_px,
       {0.0, 64.0},
       "widest gap of a row that is filled when one surface lies on both sides; 0: none"}};
  return fields;
}

void read_matcher(const JsonReader& json, MatcherModel& matcher) {
  read_fields(json, matcher_fields(), matcher);
  if (matcher.window_columns % 2 == 0) json.fail_at("window_columns", "must be odd");
  if (matcher.window_rows % 2 == 0) json.fail_at("window_rows", "must be odd");
  if (matcher.disparity_max_px <= matcher.disparity_min_px)
    json.fail_at("disparity_max_px", "must be above disparity_min_px");
}

std::span<const Field<Calibration>> calibration_fields() {
  static const Field<Calibration> fields[] = {
      {"baseline_mm", Length{&Calibration::baseline}, kLengthMm, "from the camera to the projector", true},
      {"focal_px", &Calibration::focal_px, kFocalPx, "focal length", true},
      {"principal_px", &Calibration::principal_px, kPrincipalPx, "principal point", true}};
  return fields;
}

Calibration calibration_from_json(const JsonReader& json) {
  Calibration calibration{};
  read_fields(json, calibration_fields(), calibration);
  return calibration;
}

Eigen::Vector2i size_from_json(const JsonReader& json) {
  const std::vector<JsonReader> items = json.items();
  if (items.size() != 2) json.fail("must be a width and a height");
  return {items[0].integer(16, 8192), items[1].integer(16, 8192)};
}

constexpr std::string_view kSizeSchema =
    R"({"type": "array", "items": {"type": "integer", "minimum": 16, "maximum": 8192}, "minItems": 2, "maxItems": 2})";
constexpr std::string_view kSize = "[width, height], each 16 to 8192";

std::string_view noise_schema() {
  static const std::string schema = Json{{"anyOf", {{{"enum", noise_presets()}}, {{"$ref", "#/$defs/noise"}}}}}.dump();
  return schema;
}

std::span<const Field<SensorModel>> sensor_fields() {
  using Sensor = SensorModel;
  constexpr auto in_law = [](const Field<DepthLaw>& field) { return Field<Sensor>(&Sensor::law, field); };
  static const Field<Sensor> fields[] = {
      {"baseline_mm", Length{&Sensor::baseline}, kLengthMm, "from the camera to the projector"},
      {"wavelength_nm", &Sensor::wavelength_nm, {100.0, 5000.0}, "of the projector's light"},
      {"ir_size_px",
       Part<Sensor>{[](const JsonReader& json, Sensor& sensor) {
                      const Eigen::Vector2i size = size_from_json(json);
                      sensor.ir_width = size.x(), sensor.ir_height = size.y();
                    },
                    [](const Sensor& sensor) {
                      return Json{sensor.ir_width, sensor.ir_height};
                    },
                    kSizeSchema, kSize},
       "width and height of the infrared image"},
      {"depth_size_px",
       Part<Sensor>{[](const JsonReader& json, Sensor& sensor) {
                      const Eigen::Vector2i size = size_from_json(json);
                      sensor.width = size.x(), sensor.height = size.y();
                      sensor.principal_px = 0.5 * size.cast<double>();
                    },
                    [](const Sensor& sensor) {
                      return Json{sensor.width, sensor.height};
                    },
                    kSizeSchema, kSize},
       "width and height of the depth image: half of `ir_size_px`; rows beyond are cropped"},
      {"focal_px", &Sensor::focal_px, kFocalPx, "focal length of the depth image"},
      {"principal_px", &Sensor::principal_px, kPrincipalPx,
       "principal point of the depth image; its middle where only the size is given"},
      {"reference_mm", Length{&Sensor::reference}, kLengthMm, "distance of the reference plane"},
      in_law({"near_mm", Length{&DepthLaw::near}, kLengthMm,
              "nearer depths are invalid; a search of 63 px reaches to 440 mm"}),
      in_law({"far_mm", Length{&DepthLaw::far}, kLengthMm, "farther depths are invalid"}),
      {"radiant_dn_mm2", &Sensor::radiant_dn_mm2, kPositive,
       "brightness: a dot's centre on albedo 1 at r mm has this times cos θ / r²"},
      in_law({"quantization",
              Choice<DepthLaw>{{"device", "off"},
                               [](const DepthLaw& law) { return law.quantized ? std::size_t{0} : std::size_t{1}; },
                               [](DepthLaw& law, std::size_t choice) { law.quantized = choice == 0; }},
              "device: depths are rounded to the device's steps of 1/8 px of disparity; off: they are not"}),
      in_law({"depth_step_phase",
              &DepthLaw::step_phase,
              {-2.0, 2.0},
              "offset of the depth steps, as a share of a step; 0.5: halfway between two codes"}),
      in_law({"codes_per_step", &DepthLaw::codes_per_step, {1.0, 64.0}, "number of codes of 1/8 px in one depth step"}),
      in_law({"depth_cut_mm",
              Length{&DepthLaw::cut},
              {0.0, 100.0},
              "depths are truncated to multiples of this; 0: they are not"}),
      {"optics",
       Part<Sensor>{[](const JsonReader& json, Sensor& sensor) { read_fields(json, optics_fields(), sensor.optics); },
                    [](const Sensor& sensor) { return json_from_fields(optics_fields(), sensor.optics); },
                    "#/$defs/optics", "an object"},
       "lenses: speckle's grain, defocus, distortion"},
      {"noise",
       Part<Sensor>{[](const JsonReader& json, Sensor& sensor) { sensor.noise = noise_from_json(json); },
                    [](const Sensor& sensor) { return json_from_noise(sensor.noise); }, noise_schema(),
                    "a name or an object"},
       "`off`; `basic`: speckle of the dots, shot and read noise; `landau_2016`: constants as published; `device`: "
       "speckle of the pixels, in the reference image as well, shot and read noise, ambient light, blooming; or an "
       "object of parts"},
      {"unit",
       Part<Sensor>{[](const JsonReader& json, Sensor& sensor) { sensor.unit = unit_from_json(json, sensor.unit); },
                    [](const Sensor& sensor) { return json_from_fields(unit_fields(), sensor.unit); },
                    R"({"anyOf": [{"type": "string"}, {"$ref": "#/$defs/unit"}]})", "a path or an object"},
       "how this individual device differs from its model: a unit.json of fathom calibrate, which switches residue_px "
       "off, or an object"},
      {"pattern",
       Part<Sensor>{[](const JsonReader& json, Sensor& sensor) { read_pattern(json, sensor.pattern); },
                    [](const Sensor& sensor) { return json_from_fields(pattern_fields(), sensor.pattern); },
                    "#/$defs/pattern", "an object"},
       "the projected dots"},
      {"matcher",
       Part<Sensor>{[](const JsonReader& json, Sensor& sensor) { read_matcher(json, sensor.matcher); },
                    [](const Sensor& sensor) { return json_from_fields(matcher_fields(), sensor.matcher); },
                    "#/$defs/matcher", "an object"},
       "how disparities are found"},
      {"believed",
       Part<Sensor>{[](const JsonReader& json, Sensor& sensor) { sensor.believed = calibration_from_json(json); },
                    [](const Sensor& sensor) {
                      return sensor.believed ? json_from_fields(calibration_fields(), *sensor.believed) : Json();
                    },
                    "#/$defs/calibration", "an object"},
       "calibration that the device computes depths and points with, where it differs from the true one"}};
  return fields;
}

/// Everything but the pose, which `besides` names.
void read_model(const JsonReader& json, SensorModel& sensor, std::span<const std::string_view> besides) {
  read_fields(json, sensor_fields(), sensor, besides);
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
  if (sensor.law.far <= sensor.law.near) json.fail_at("far_mm", "must be above near_mm");
  if (const UnitMap* map = sensor.unit.learned.map.get();
      map && (sensor.width != map->camera.width() || sensor.height != map->camera.height()))
    json.fail_at("unit", fmt::format("was learned of a depth image of {} × {} pixels, and depth_size_px is {} × {}",
                                     map->camera.width(), map->camera.height(), sensor.width, sensor.height));
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
  const double roll = radians_from_deg(json.number_or("roll_deg", 0.0, kRollDeg));
  if (json.has("aim_mm") == json.has("pitch_deg")) json.fail("needs either aim_mm or pitch_deg beside height_mm");
  if (json.has("pitch_deg"))
    return camera_pose(midpoint, radians_from_deg(json.number("pitch_deg", kPitchDeg)), 0.0, roll, baseline);
  const Eigen::Vector3d forward = json.at("aim_mm").vector3(kPlaceMm) * kMetresPerMm - midpoint;
  if (forward.norm() == 0.0) json.fail_at("aim_mm", "must not be the sensor's own place");
  const double horizontal = std::hypot(forward.x(), forward.y());
  const double yaw = horizontal > 0.0 ? std::atan2(-forward.x(), forward.y()) : 0.0;
  return camera_pose(midpoint, std::atan2(-forward.z(), horizontal), yaw, roll, baseline);
}

/// Which sensor, and where it stands: keys that rig_from_json() reads together.
std::span<const Field<SensorModel>> place_fields() {
  static const Field<SensorModel> fields[] = {
      {"model", unread<SensorModel>(R"({"type": "string"})", "a name"),
       "a model of `fathom list sensors`; the other keys change it. `xtion_pro_live` and `kinect_v1` match ideally, "
       "for work "
       "on what light does; names that end in `_device` imitate the real device"},
      {"name", unread<SensorModel>(R"({"type": "string"})", "a text"), "what a sensor without `model` is called"},
      {"height_mm", Part<SensorModel>{}, kLengthMm, "height of the baseline's middle above the desk"},
      {"aim_mm", unread<SensorModel>("#/$defs/place3", "[x, y, z]"),
       "the point of the world that the baseline's middle looks at; or `pitch_deg`"},
      {"pitch_deg", Part<SensorModel>{}, kPitchDeg, "angle below the horizontal; 90: straight down"},
      {"roll_deg", Part<SensorModel>{}, kRollDeg, "turn about the optical axis, clockwise as seen from behind"},
      {"world_from_camera",
       unread<SensorModel>(
           R"({"type": "array", "items": {"type": "array", "items": {"type": "number"}, "minItems": 4, "maxItems": 4}, "minItems": 4, "maxItems": 4})",
           "4 rows of 4 numbers"),
       "pose of the infrared camera instead of height and angles: rotation, and translation in metres"}};
  return fields;
}

}  // namespace

Json json_from_pose(const Pose& pose) {
  Json rows = Json::array();
  for (int i = 0; i < 4; ++i) rows.push_back({pose(i, 0), pose(i, 1), pose(i, 2), pose(i, 3)});
  return rows;
}

Rig rig_from_json(const JsonReader& json) {
  std::vector<std::string_view> place;
  for (const auto& field : place_fields()) place.push_back(field.key);
  Rig rig;
  rig.sensor.noise = basic_noise();
  rig.sensor.name = json.text_or("name", "");  // of a full description
  if (json.has("model")) {
    if (json.has("name")) json.fail_at("name", "cannot stand beside model, which already says it");
    const std::string name = json.text("model");
    const std::filesystem::path file =
        library_file("sensors", "sensor model", name, json.file(), json.pointer() + "/model");
    const Json text = read_json(file);
    constexpr std::string_view kSource[] = {"source"};
    read_model(JsonReader(text, file.string()), rig.sensor, kSource);
    rig.sensor.name = name;
  }
  read_model(json, rig.sensor, place);
  rig.world_from_camera = pose_from_json(json, rig.sensor.baseline);
  return rig;
}

Json json_from_rig(const Rig& rig) {
  Json json = Json::object();
  if (!rig.sensor.name.empty()) json["name"] = rig.sensor.name;
  json["world_from_camera"] = json_from_pose(rig.world_from_camera);
  json.update(json_from_fields(sensor_fields(), rig.sensor));
  return json;
}

std::vector<KeyTable> sensor_key_tables() {
  SensorModel standard;
  standard.noise = basic_noise();
  std::vector<KeyRow> sensor = key_rows(place_fields(), standard);
  for (KeyRow& row : key_rows(sensor_fields(), standard)) sensor.push_back(std::move(row));
  return {{"sensor", "sensor", "Sensor", std::move(sensor)},
          {"sensor.pattern", "pattern", "Pattern", key_rows(pattern_fields(), standard.pattern)},
          {"sensor.optics", "optics", "Optics", key_rows(optics_fields(), standard.optics)},
          {"sensor.noise", "noise", "Noise", noise_keys()},
          {"sensor.noise.disparity", "disparity_noise", "Noise of geometric captures", disparity_noise_keys()},
          {"sensor.matcher", "matcher", "Matcher", key_rows(matcher_fields(), standard.matcher)},
          {"sensor.unit", "unit", "Unit", key_rows(unit_fields(), standard.unit)},
          {"sensor.believed", "calibration", "Believed calibration",
           key_rows(calibration_fields(), standard.calibration())}};
}

}  // namespace fathom
