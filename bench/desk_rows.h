// What a desk with things on it says about the sensor: the same numbers of measured clouds and of simulated ones.
#pragma once

#include <string>
#include <vector>

#include "bench/measured_desks.h"
#include "sim/scene/rig.h"

namespace fathom {

/// One number of one distance's desk, or of the whole image (distance 0).
struct DeskRow {
  std::string observable, region;
  double distance_mm;
  double value;
};

/// In bands of distance that hold at least five windows of bare desk (desk_noise.h): "sigma_steps"; "correlation" along
/// rows ("x 1" …) and columns ("y 1" …); "slow_bias_mm", root mean square of the windows' mean heights above the plane,
/// and "rough_bias_mm" of what windows side by side differ by; "comb_strength", the mean cosine of the disparities in
/// steps, 1 where they stand half a step between the table's codes, and "millimetre_comb" of the depths. Of the whole
/// image "shadow_share", the part of the shadows that lies to the left of the things that throw them.
std::vector<DeskRow> desk_rows(const SensorModel& sensor, const DeskImage& image);

}  // namespace fathom
