#include "openni2/pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/sensor/depth.h"

namespace fathom {

double colour_focal_px(const Setup& setup) {
  return setup.processing.colour_view ? kColourFocalPx : setup.rig.sensor.focal_px;
}

Image<std::uint16_t> depth_pixels(const Setup& setup, const Frame& frame, double unit, bool registered) {
  const SensorModel& sensor = setup.rig.sensor;
  const Image<float> depth = depth_image(sensor, frame.disparity_px, cut_of(sensor, unit));
  return depth_in_units(registered ? registered_to_colour(depth, sensor.focal_px, colour_focal_px(setup)) : depth,
                        unit);
}

int infrared_full_scale(const SensorModel& sensor) {
  return sensor.noise.bits > 0 ? (1 << sensor.noise.bits) - 1 : std::numeric_limits<std::uint16_t>::max();
}

Image<std::uint16_t> infrared_pixels(const SensorModel& sensor, const Frame& frame, int width) {
  const Image<float> ir = width == sensor.width ? at_depth_scale(sensor, frame.ir) : frame.ir;
  const float full_scale = static_cast<float>(infrared_full_scale(sensor));
  Image<std::uint16_t> pixels(ir.width(), ir.height());
  for (std::size_t i = 0; i < ir.size(); ++i)
    pixels.pixels()[i] = static_cast<std::uint16_t>(std::lround(std::clamp(ir.pixels()[i], 0.0f, full_scale)));
  return pixels;
}

void copy_region(const Image<std::uint16_t>& image, const OniCropping& part, bool mirrored, std::uint16_t* to) {
  for (int y = 0; y < part.height; ++y, to += part.width) {
    const std::uint16_t* row = image.row(part.originY + y);
    if (mirrored)
      std::reverse_copy(row + image.width() - part.originX - part.width, row + image.width() - part.originX, to);
    else
      std::copy_n(row + part.originX, part.width, to);
  }
}

}  // namespace fathom
