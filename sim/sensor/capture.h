// One shot of the simulated sensor: scene, image, match, depth, cloud.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud_file.h"
#include "core/image.h"
#include "sim/render/truth.h"
#include "sim/scene/setup.h"
#include "sim/sensor/disparity_noise.h"
#include "sim/sensor/imaged_view.h"
#include "sim/sensor/turbid_part.h"

namespace fathom {

inline constexpr int kDefaultSamplesPerPixel = 4;  ///< of the infrared image, on a square grid

enum class CaptureMode {
  geometric,   ///< every pixel's exact refracted triangulation, noise by statistics, where the sensor has them; liquids
               ///< that scatter are imaged and matched (sim/sensor/turbid_part.h)
  photometric  ///< infrared image → matching → depth
};

/// The light that the images of campaigns and of predictions are made of: all of it where a liquid lets it in before it
/// scatters it back or an effect is about it, else direct light, which carries no noise of its own. Where a liquid
/// sends it back from less than 0.05 mm below its surface it is direct, too: walks take too long there. Effects are
/// switched on already.
LightModel measured_light(const Setup& setup);

/// The light of a capture, unless one asks for another: of images of anything that stands on a desk all of it, since
/// cups and goods throw light on one another, and liquids and glass mirror it. Direct light where there is no other, on
/// a bare desk, and where walks take too long; geometric captures have measured_light().
LightModel ordinary_light(const Setup& setup, CaptureMode mode);

/// What files and options call the light, and what they mean: ordinary_light() by "auto". Throws Error on other names.
const std::vector<std::string>& light_names();
std::optional<LightModel> light_named(const std::string& name);
/// What run.json calls it.
const char* name_of(LightModel light);

struct Frame {
  Image<float> ir;            ///< [DN] ir_width × ir_height; empty in geometric mode
  Image<float> disparity_px;  ///< f b / Z, 0 = invalid
  Image<float> depth;         ///< [m], 0 = invalid
  Image<CloudPoint> cloud;    ///< camera frame [m]
};

/// A scene that is ready to be shot several times: traced, rendered and memorised once.
class Camera {
 public:
  /// `light`: of images, ordinary_light() if it is not given; in geometric mode direct light takes liquids that scatter
  /// for opaque. Where an effect of light is on, direct light is not enough, and ordinary_light() decides.
  Camera(const Setup& setup, CaptureMode mode, int samples_per_pixel, std::uint64_t seed,
         std::optional<LightModel> light = std::nullopt);

  /// What is shot: the set-up with its effects switched on.
  const Setup& setup() const { return setup_; }

  /// The frame of that number; only the noise differs from frame to frame.
  Frame shoot(std::uint64_t frame);

  /// What its images are made of.
  LightModel light() const { return light_; }
  const Geometry& geometry() const { return geometry_; }
  const Image<TruePixel>& truth() const { return truth_; }
  /// What every infrared pixel receives from the projector before noise and speckle on pixels [DN], ir_width ×
  /// ir_height; empty in geometric mode.
  const Image<float>& radiance() const;
  /// Samples per infrared pixel after rounding up to a square grid; 0 where there are no images.
  int samples_per_pixel() const { return samples_across_ * samples_across_; }
  const CaptureStatistics& statistics() const { return statistics_; }

 private:
  Frame shoot_geometric(std::uint64_t frame);
  Frame shoot_photometric(std::uint64_t frame);

  Setup setup_;  ///< with its effects
  CaptureMode mode_;
  std::uint64_t seed_;
  LightModel light_ = LightModel::direct;
  int samples_across_ = 0;
  Geometry geometry_;
  Image<TruePixel> truth_;
  CaptureStatistics statistics_;
  std::optional<ImagedView> view_;  ///< of photometric mode only
  // Of geometric mode only, empty where there is none.
  std::vector<TurbidPart> turbid_;
  BlockChance still_chance_;
  Image<float> residue_;  ///< of the reference [px]
};

}  // namespace fathom
