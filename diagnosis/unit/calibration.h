// A device as its clouds of desks and walls show it: bias over the image, noise, steps of depth, warming up.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "detector/plane.h"
#include "diagnosis/unit/bias_prior.h"
#include "diagnosis/unit/calibration_view.h"
#include "diagnosis/unit/depth_facts.h"
#include "diagnosis/unit/pixel_noise.h"
#include "diagnosis/unit/warm_up.h"

namespace fathom {

struct CalibrationCloud {
  std::filesystem::path file;
  std::optional<double> time_s;  ///< since the device was switched on
};

struct CalibrationOptions {
  std::optional<DeskPrior> mounted;  ///< where the desk is; else the plane of most points
  std::optional<double> focal_px;    ///< of disparities; else as the depths' law or the clouds' rays have it
  std::optional<bool> registered;    ///< to the colour camera; else as the clouds' rays have it
  double baseline_m = 0.075;
};

/// Clouds whose desks lie alike, by the first of them.
struct CalibrationPose {
  int clouds = 0;
  double height_mm = 0.0, pitch_deg = 0.0, roll_deg = 0.0;  ///< of the clouds' camera over the desk
  Image<float> bias_px;  ///< what the device does in that pose, at the clouds' pixels
};

/// Images are 640 × 480 [px of disparity].
struct UnitCalibration {
  std::size_t clouds = 0, views = 0, cells = 0;
  DeviceScale scale;
  double image_focal_px = 0.0;  ///< of the clouds' own image
  BiasPrior prior;
  Image<float> bias_px, sigma_px;  ///< at the clouds' pixels, where they show the mean of their desks
  Image<char> seen;                ///< at the same pixels: 1 where any view has desk, else 0
  Image<float> reference_px, camera_px;
  double reference_at_px = 0.0;  ///< see core/unit_map.h
  std::vector<CalibrationPose> poses;
  double without_px = 0.0;  ///< root mean square over the cells, each view's plane apart
  double left_px = 0.0;     ///< the same when each view is predicted from others; of one view: from itself
  PixelNoise noise;
  DepthFacts depths;
  std::optional<WarmUp> warm_up;
};

/// Reads every cloud once, but the first few twice. Throws Error naming the cloud without a desk. Tells of its progress
/// unless `quiet`.
UnitCalibration calibrate(const std::vector<CalibrationCloud>& clouds, const CalibrationOptions& options,
                          bool quiet = true);

/// unit_bias.exr, then unit.json.
void write_unit(const std::filesystem::path& folder, const UnitCalibration& calibration);

}  // namespace fathom
