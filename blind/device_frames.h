// The device at work: frames of one placement, as clouds.
#pragma once

#include <cstdint>
#include <vector>

#include "blind/block_mean.h"
#include "blind/pack_plan.h"
#include "core/cloud_file.h"

namespace fathom::blind {

/// A placement matched once; its frames differ in their noise. Errors that stay while nothing moves are keyed by
/// `standing`, those of one frame by `frame`.
struct Scene {
  Matched matched;
  std::vector<double>
      standing_px;        ///< what each block is off by its place in the image, and the error of its dots that stays
  std::vector<float> dn;  ///< infrared
};

Raster near_cup(const Placement& placement);  ///< every 2nd pixel of the cup and 12 mm around it
Raster whole_image();                         ///< every 12th

/// What a place in the image is off, whatever stands there; the unit's own bias goes with the place that it remembers.
double field_px(const World& world, const Eigen::Vector2d& pixel, double disparity_px);

Scene stand(const World& world, const std::vector<Dot>& dots, bool has_cup, const Raster& raster,
            std::uint64_t standing);

/// What a whole frame has in common.
struct Shake {
  double offset_px, phase;
};
Shake shake_of(const World& world, std::uint64_t frame);

/// Disparity of each block of one frame, before the device's steps.
std::vector<double> disparities(const Scene& scene, const World& world, const Shake& shake, std::uint64_t frame);

/// The cloud of several scenes shot together; of later ones only what lies outside the first's raster.
void append_points(const Scene& scene, const World& world, const Shake& shake, std::uint64_t frame,
                   const Raster* but_not_in, std::vector<CloudPoint>& cloud);

}  // namespace fathom::blind
