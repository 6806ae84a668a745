// Where a geometric capture sees light that a liquid has scattered. There exact triangulation would know only a
// surface: how far below it the dots seem to lie, and whether a matcher still finds them, their image decides. So the
// part of the image that shows such a liquid is rendered and matched like a photometric capture.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/image.h"
#include "sim/render/truth.h"
#include "sim/sensor/imaged_view.h"

namespace fathom {

/// A rectangle of the depth image [px].
struct ImagePart {
  int left, top, width, height;
};

/// The sensor that sees this part and nothing else, with a reference of its own. Its unit has no errors, because those
/// belong to places in the whole image.
SensorModel sensor_of_part(const SensorModel& sensor, const ImagePart& part);

/// By the number of each liquid in sight that scatters, what a match of its pixels reads.
std::map<int, ImagePart> parts_with_liquids(const Image<TruePixel>& truth, const SensorModel& sensor);

class TurbidPart {
 public:
  TurbidPart(const ImagePart& part, ImagedView view, int object);

  /// Disparities of the part in the frame of that number [px], 0 = invalid.
  Image<float> match(std::uint64_t frame, CaptureStatistics& statistics) const;
  /// Puts them into the whole image where `truth` sees light that this part's liquid has scattered.
  void put(const Image<float>& matched_px, const Image<TruePixel>& truth, Image<float>& disparity_px) const;

 private:
  ImagePart part_;
  ImagedView view_;
  int object_;
};

/// One for each liquid in sight that scatters, in LightModel::scattered.
std::vector<TurbidPart> turbid_parts(const PointLight& projector, const Rig& rig, const Image<TruePixel>& truth,
                                     int samples_across, std::uint64_t seed, CaptureStatistics& statistics);

}  // namespace fathom
