// Clouds of simple scenes by exact ray casting: what an ideal depth camera sees of cups and boxes on a desk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "detector/cloud.h"
#include "detector/plane.h"

namespace fathom::synthetic {

/// The pose of a sensor that looks at a point of the desk straight ahead.
DeskPrior looking_at(double height_m, double distance_m);

/// An upright open cylinder, as the paper's cup. World frame: z up, desk top z = 0, y away from the sensor.
struct OpenCup {
  double x_m = 0.0, y_m = 0.40;
  double height_m = 0.087;
  double inner_radius_m = 0.040;
  double outer_radius_m = 0.043;
  double floor_m = 0.007;    ///< height of what is seen inside: the bottom, the raised bottom or a surface
  double mound_slope = 0.0;  ///< of a cone that is heaped upon it, tip on the axis and foot at the wall
  double lean_slope = 0.0;   ///< of the floor, which then rises away from the sensor and has its height on the axis
};

/// Axis-parallel, standing on the desk.
struct Box {
  Eigen::Vector2d low, high;
  double height_m;
};

struct Scene {
  std::vector<OpenCup> cups;
  std::vector<Box> boxes;
  bool desk = true;  ///< 1.4 m × 1.0 m, its near edge 0.05 m from the sensor's foot
  DeskPrior sensor = looking_at(0.650, 0.400);
  double yaw_rad = 0.0;  ///< turns the camera about the vertical through it
  int width = 320, height = 240;
  double focal_px = 285.171;  ///< the Xtion's at half its resolution
  double noise_m = 0.0;       ///< standard deviation along the line of sight
  std::uint64_t seed = 1;
};

Cloud cast(const Scene& scene);

/// A PCD of one paper cup straight ahead at 400 mm; `floor_m` as in OpenCup.
void write_cup(const std::filesystem::path& path, double floor_m);

/// The same as an Xtion sees it, thinned and without rows: every second pixel about the cup, of the desk every 16th.
void write_thinned_cup(const std::filesystem::path& path, double floor_m);

}  // namespace fathom::synthetic
