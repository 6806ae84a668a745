#include "sim/sensor/imaged_view.h"

#include <utility>

#include "core/timed.h"
#include "sim/sensor/match.h"
#include "sim/sensor/speckle.h"

namespace fathom {

ImagedView::ImagedView(const PointLight& projector, const Rig& rig, const Pattern& pattern,
                       std::shared_ptr<const Reference> reference, int samples_across, LightModel light,
                       std::uint64_t seed, CaptureStatistics& statistics)
    : sensor_(rig.sensor), reference_(std::move(reference)), seed_(seed) {
  light_ = timed(statistics.render_s, [&] { return render_ir(projector, rig, pattern, samples_across, light, seed); });
  statistics.camera_rays += light_.projected.size() * samples_across * samples_across;
  speckle_ = speckle_field(sensor_, sensor_.noise.pixel_speckle, sensor_.ir_width, sensor_.ir_height, seed);
}

ImagedFrame ImagedView::shoot(std::uint64_t frame, CaptureStatistics& statistics) const {
  Image<float> light = light_.projected;
  add_speckle(renewed_speckle(sensor_, speckle_, seed_, frame), light);
  for (std::size_t i = 0; i < light_.ambient.size(); ++i) light.pixels()[i] += light_.ambient.pixels()[i];
  ImagedFrame shot;
  shot.ir = expose(light, sensor_.noise, seed_, frame);
  shot.disparity_px = timed(statistics.match_s, [&] { return match(sensor_, shot.ir, *reference_); });
  return shot;
}

}  // namespace fathom
