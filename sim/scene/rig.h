// The sensor and where it stands: cameras, projector, pattern, noise, matcher, depth law. SI and radians; pixels are of
// the depth image (640×480) unless the name says ir.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/json_fwd.h"
#include "core/pose.h"
#include "sim/scene/noise.h"
#include "sim/scene/optics_model.h"
#include "sim/scene/unit_model.h"

namespace fathom {

/// Brightness of every position of the grid, 0 … 1, from a file.
struct PatternImage {
  std::shared_ptr<const Image<float>> brightness;  ///< nothing: none
  std::string file;

  /// Images are the same that have the same brightness, whatever files they came from.
  bool operator==(const PatternImage& other) const;
};

/// The projected dots. A grid of positions, one step of `step_px` depth pixels of angle apart, made of equal tiles.
struct PatternModel {
  int tile_columns = 211, tile_rows = 165;  ///< positions in a tile; the published drawing has the same
  int tiles_across = 4, tiles_down = 3;     ///< the drawing shows 3×3; a fourth keeps the view lit down to 0.45 m
  double step_px = 1.0;
  int dots_per_tile = 3861;      ///< 11.1 % of the positions
  double dot_sigma_ir_px = 0.9;  ///< standard deviation of a dot's image, lens included
  double zero_order = 1.0;       ///< brightness of the spot in each tile's middle over that of a dot
  double tile_spread = 0.0;      ///< standard deviation of the tiles' brightness over their mean
  std::uint64_t seed = 1;
  PatternImage image;  ///< instead of dots of our own

  bool operator==(const PatternModel&) const = default;
};

enum class MatchMethod {
  precise,  ///< slopes and edges are followed, which no device does
  device    ///< plain block correlation: see sim/sensor/block_match.h
};

struct MatcherModel {
  MatchMethod method = MatchMethod::precise;
  int window_columns = 9, window_rows = 9;  ///< odd, depth pixels
  int disparity_min_px = -32;               ///< of the search, relative to the reference plane; positive = nearer
  int disparity_max_px = 63;
  double correlation_min = 0.55;       ///< least zero-mean normalised cross-correlation of a match
  double contrast_min = 4.0;           ///< least standard deviation of the window [DN]
  double relative_contrast_min = 0.0;  ///< the same over the window's mean; device's method only
  double compression = 0.0;  ///< [DN] blocks are compared in √(light + this); 0: in light; device's method only
  int hole_max_px = 0;       ///< widest gap of a row that is filled when one surface lies on both sides; 0 = none

  bool operator==(const MatcherModel&) const = default;
};

/// What the device takes for its own numbers when it makes depths and points of disparities.
struct Calibration {
  double baseline;  ///< [m]
  double focal_px;
  Eigen::Vector2d principal_px;

  bool operator==(const Calibration&) const = default;
};

/// What becomes of a disparity on its way to a depth.
struct DepthLaw {
  double near = 0.45, far = 10.0;  ///< depths outside are invalid; nearer ones the search does not reach
  bool quantized = true;           ///< depth on the device's law; false: float depth
  double step_phase = 0.5;         ///< where the law's depths lie between whole codes [steps]; the vendor's own SDK: 0
  int codes_per_step = 1;          ///< the law has a code for every 1/8 px; a matcher may resolve no more than some
  double cut = 1e-3;               ///< [m] the law's depths are cut to whole multiples of it; 0: they are not

  bool operator==(const DepthLaw&) const = default;
};

struct SensorModel {
  std::string name = "xtion_pro_live";  ///< of the model; empty for a full description
  double baseline = 0.075;
  double wavelength_nm = 830.0;
  int ir_width = 1280, ir_height = 1024;
  int width = 640, height = 480;           ///< of the depth image: the middle of the infrared image, halved
  double focal_px = 1200.0 / (2 * 1.052);  ///< zero plane distance over twice the zero plane pixel size
  Eigen::Vector2d principal_px{320.0, 240.0};
  double reference = 1.2;          ///< distance of the memorised reference plane
  double radiant_dn_mm2 = 5.90e8;  ///< a dot's centre on albedo 1 at r mm: this · cos θ / r² [DN] (Landau 2016)
  DepthLaw law;
  PatternModel pattern;
  OpticsModel optics;
  NoiseModel noise;
  MatcherModel matcher;
  UnitModel unit;
  std::optional<Calibration> believed = {};  ///< where the calibration erred; nothing: the numbers above

  Calibration calibration() const { return believed.value_or(Calibration{baseline, focal_px, principal_px}); }
  double ir_scale() const { return static_cast<double>(ir_width) / width; }
  int ir_first_row() const { return (ir_height - static_cast<int>(ir_scale()) * height) / 2; }

  bool operator==(const SensorModel&) const = default;
};

struct Rig {
  SensorModel sensor;
  Pose world_from_camera = Pose::Identity();  ///< camera: x right, y down, z forward, origin at the infrared camera

  Eigen::Vector3d camera_in_world() const { return world_from_camera.translation(); }
  Eigen::Vector3d projector_in_world() const { return world_from_camera * Eigen::Vector3d(sensor.baseline, 0.0, 0.0); }
  /// Unit direction in the world of a point of the depth image; (0.5, 0.5) is the first pixel's centre.
  Eigen::Vector3d direction_in_world(double x_px, double y_px) const {
    // Single numbers stay in registers; a vector would go by way of memory, which takes longer than the arithmetic.
    double x = x_px - sensor.principal_px.x(), y = y_px - sensor.principal_px.y();
    const double z = sensor.focal_px;
    if (sensor.optics.distorts()) {
      const Eigen::Vector2d direction = sensor.optics.undistorted({x / z, y / z});
      x = direction.x() * z, y = direction.y() * z;
    }
    const double scale = 1.0 / std::sqrt(x * x + y * y + z * z);
    return world_from_camera.linear() * Eigen::Vector3d(scale * x, scale * y, scale * z);
  }
  /// Rectified image coordinates of a direction, in units of the focal length; the same for camera and projector.
  /// Nothing for a direction that does not go forward.
  std::optional<Eigen::Vector2d> rectified(const Eigen::Vector3d& direction_in_world) const {
    const auto axes = world_from_camera.linear();
    const double forward = axes.col(2).dot(direction_in_world);
    if (forward <= 0.0) return std::nullopt;
    return Eigen::Vector2d(axes.col(0).dot(direction_in_world) / forward,
                           axes.col(1).dot(direction_in_world) / forward);
  }

  bool operator==(const Rig& other) const {
    return sensor == other.sensor && world_from_camera.matrix() == other.world_from_camera.matrix();
  }
};

/// A pose from the baseline's midpoint: `pitch` below the horizontal, `yaw` to the left of +y, `roll` clockwise.
Pose camera_pose(const Eigen::Vector3d& midpoint_in_world, double pitch, double yaw, double roll, double baseline);

/// How a camera without the yaw of its direction is turned about its optical axis, clockwise: from the horizontal to
/// the camera's right. Looking straight up or down, the yaw cannot be told from the roll and counts as none.
double roll_of(const Eigen::Matrix3d& world_from_camera);

/// The "sensor" of a scene file: a model's name with or without changes, and the pose.
Rig rig_from_json(const JsonReader& json);

/// The whole description, as it can be read back.
Json json_from_rig(const Rig& rig);

/// What may stand in a sensor's description.
std::vector<KeyTable> sensor_key_tables();

/// Four rows of four numbers; lengths in metres.
Json json_from_pose(const Pose& pose);

}  // namespace fathom
