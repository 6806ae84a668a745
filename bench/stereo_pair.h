// One matching problem in two forms: as match() takes it, and as two 8-bit images for OpenCV's stereo matchers.
#pragma once

#include <opencv2/core.hpp>

#include "bench/bench_scene.h"
#include "sim/sensor/reference.h"

namespace fathom {

struct StereoPair {
  SensorModel sensor;
  Image<float> ir;  ///< [DN] ir_width × ir_height
  Reference reference;
  Image<float> true_disparity_px;  ///< width × height, relative to the reference plane; NaN where no dots fall
  cv::Mat live;                    ///< the halved infrared image, width × height, 8 bits
  cv::Mat halved_reference;  ///< the halved reference without its margin; live pixel x meets pixel x − disparity
};

StereoPair make_stereo_pair(Setup setup, const NoiseModel& noise);

}  // namespace fathom
