// Dots to disparity: correlation of the infrared image against the memorised reference.
//
//   search: whole depth pixels, by zero-mean normalised cross-correlation over the matcher's window, on halved images,
//     at every sixth pixel;
//   refine: fractions of an infrared pixel, by the shift that maximises the correlation with the reference and its
//     derivative, in closed form, on images of full width; tile by tile, so that windows share their sums;
//   carry: that shift belongs to the centroid of the window's gradient energy, the local slope carries it to the pixel;
//   settle: near edges, the surface whose prediction explains the few dots around the pixel itself;
//   fill: narrow gaps within one surface, when the matcher is asked to.
//
// The device's own way is less: the same search, block_match(), the same filling.
#pragma once

#include <cmath>
#include <limits>

#include "core/image.h"
#include "sim/sensor/reference.h"

namespace fathom {

/// Disparities f b / Z at the depth image's scale [px], 0 = invalid. `ir` is the whole infrared image [DN], ir_width ×
/// ir_height.
Image<float> match(const SensorModel& sensor, const Image<float>& ir, const Reference& reference);

// The steps, each from one image to the next. `paired` is the infrared image with its rows in pairs.

/// What is known at every pixel about the surface there, one image per quantity. Disparities are relative to the
/// reference plane, in depth pixels.
struct Estimates {
  Image<float> disparity;           ///< NaN: no match
  Image<float> correlation;         ///< of the window, −1 … 1
  Image<float> centre_x, centre_y;  ///< where `disparity` holds, from the pixel's centre [px]
  Image<float> slope_x, slope_y;    ///< of the disparity [px/px]

  Estimates(int width, int height)
      : disparity(width, height, std::numeric_limits<float>::quiet_NaN()),
        correlation(width, height),
        centre_x(width, height),
        centre_y(width, height),
        slope_x(width, height),
        slope_y(width, height) {}
  bool valid(int x, int y) const { return disparity(x, y) == disparity(x, y); }
};

/// One row of kSearchStep is searched, the middle one, and in it every second column: neighbouring windows hold nearly
/// the same dots.
inline constexpr int kSearchStep = 3;

/// Disparity of the best window at every searched pixel, interpolated from the scores [px]; NaN without a peak inside
/// the range.
Image<float> search(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference);

/// Sub-pixel disparity at the centroid of each window, with the correlation there, from what the search found.
Estimates refine(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference,
                 const Image<float>& coarse);

/// Fills in the slopes and moves every disparity from its centroid to its pixel's centre.
void carry_to_pixels(Estimates& estimates);

/// Where windows reach over an edge, replaces each estimate by the neighbouring one that predicts the pixel's own dots
/// best, or by none when none does. `coarse` is what the search found.
void settle_edges(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference,
                  const Image<float>& coarse, Estimates& estimates);

/// Fills gaps of at most `most_px` in each row between pixels of one surface, along the straight line between them.
void fill_holes(int most_px, Image<float>& disparity);

/// A disparity as a place in the reference: whole depth pixels, phase, and what is left over. Odd columns of the live
/// image meet the phase `odd()`.
struct ReferenceShift {
  int whole;
  int phase;
  float rest_px;  ///< |rest| ≤ ½ / kPhases

  ReferenceShift odd() const {
    constexpr int kHalf = kPhases / 2;
    return {whole + (phase + kHalf) / kPhases, (phase + kHalf) % kPhases, rest_px};
  }
};
inline ReferenceShift reference_shift(float disparity) {
  constexpr int kOffset = 1 << 14;  // keeps the rounded number positive; integer conversion is cheaper than floor()
  const int steps = static_cast<int>(-kPhases * disparity + 0.5f + kOffset);
  return {steps / kPhases - kOffset / kPhases, steps % kPhases,
          -disparity - static_cast<float>(steps - kOffset) / kPhases};
}

}  // namespace fathom
