// What a frame of a data set shows, as labels: which thing is where, which of its pixels are seen, what the cups hold.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "datasets/model.h"
#include "sim/sensor/capture.h"

namespace fathom {

/// Of pixels: left, top, width, height; nothing for an empty mask, and {-1, -1, -1, -1} in files, as BOP has it.
struct PixelBox {
  int x, y, width, height;
};

/// A mask in runs, as COCO has them: columns one after the other, first the number of zeros.
struct RunLengths {
  int width, height;
  std::vector<int> counts;
  std::optional<PixelBox> box;  ///< around the mask

  int area() const;  ///< pixels of the mask
};
RunLengths run_lengths(const Image<std::uint8_t>& mask);

/// What a cup holds, where some of it is in sight.
struct LiquidLabel {
  std::string name;
  bool is_turbid;  ///< its surface is what is measured; else what lies under it
  double index;    ///< of refraction, at the sensor's wavelength
  double fill_mm;
  double surface_mm, bottom_mm;         ///< heights above the desk: of the level, of the inner bottom's centre
  std::optional<double> apparent_mm{};  ///< median height that a camera without noise measures where the liquid is seen
  Image<std::uint8_t> mask;             ///< 255 where the liquid's surface is the first that is seen
  RunLengths runs{};                    ///< of `mask`
};

struct InstanceLabel {
  const Model* model;
  std::size_t index;  ///< of the scene's cups, or of its objects
  Pose camera_from_model;
  Image<std::uint8_t> whole{};          ///< 255 where it would be seen alone
  Image<std::uint8_t> visible;          ///< 255 where it, or a liquid in it, is the first that is seen
  RunLengths visible_runs{};            ///< of `visible`
  int whole_pixels = 0;                 ///< of its silhouette, also beyond the image
  std::optional<PixelBox> whole_box{};  ///< of the silhouette, also beyond the image
  int valid = 0;                        ///< pixels of `whole` whose depth is in the depth image
  std::optional<LiquidLabel> liquid{};
};

inline constexpr double kDepthUnitMm = 0.1;  ///< of 16-bit depth images

/// What a frame's pixels show: depths in tenths of a millimetre, 0 where there is none or more than 16 bits hold.
struct FramePixels {
  Image<std::uint16_t> measured;
  Image<std::uint16_t> seen;      ///< of the first diffuse point on the refracted ray
  Image<std::uint16_t> apparent;  ///< what a camera without noise measures there
  Image<std::uint16_t> first;     ///< of the first surface of any kind
  Image<int> first_object;        ///< the number of what has that surface; 0: none

  FramePixels(const Camera& camera, const Frame& frame);
};

/// Of every cup and then every object of the scene. `scene` is what the camera's set-up was read from.
std::vector<InstanceLabel> label_frame(const Json& scene, const Models& models, const Camera& camera,
                                       const FramePixels& pixels);

/// BOP's and OpenCV's first pixel has its centre at (0, 0), Fathom's at (0.5, 0.5).
Eigen::Vector2d bop_principal_px(const SensorModel& sensor);
/// BOP's entry of scene_camera.json: depth images count tenths of a millimetre.
Json camera_entry(const Rig& rig);
/// BOP's entries of scene_gt.json and scene_gt_info.json.
Json pose_entry(const InstanceLabel& instance);
Json info_entry(const InstanceLabel& instance);
/// What BOP has no place for: where a cup's rim and handle are, its box, and its liquid.
Json cup_entry(const InstanceLabel& instance, const Cup& cup);

}  // namespace fathom
