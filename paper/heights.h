// The measurement behind Fig. 5 and Fig. 14: the height in the cup for a filling and a distance.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "paper/laboratory_scene.h"
#include "sim/sensor/capture.h"

namespace fathom {

inline const std::array<PaperFilling, 7> kPaperFillings{
    {{"empty", 0}, {"water", 10}, {"water", 20}, {"water", 30}, {"milk_tea", 10}, {"milk_tea", 20}, {"milk_tea", 30}}};
inline constexpr std::array kPaperDistancesMm{200.0, 300.0, 400.0, 500.0, 600.0};

inline constexpr std::size_t kSeenDistances = 4;  ///< the fifth, 600 mm, is the one that the paper leaves out

/// The matcher looks at windows of 9 × 9 pixels: a patch that is not clearly larger is measured together with the walls
/// around it.
inline constexpr int kWindowPoints = 9 * 9, kPointsEnough = 2 * kWindowPoints;

/// One bar of Fig. 5, above the desk.
struct HeightCell {
  double mean_mm = 0.0;
  double sd_mm = 0.0;    ///< of the shots' mean heights
  double points = 0.0;   ///< inside the cup, on the average over all shots; those without any count as 0
  int seen = 0;          ///< shots in which something was seen inside
  double matched = 0.0;  ///< share of the pixels that look into the liquid, where it is lit, that are given a depth

  bool enough() const { return points >= kPointsEnough; }
};

/// One filling, over the distances.
using HeightRow = std::array<HeightCell, kPaperDistancesMm.size()>;

/// Rows in the order of kPaperFillings. Every cell is a new placement, with speckle of its own; its shots differ in
/// their noise.
struct PaperHeights {
  std::array<HeightRow, kPaperFillings.size()> rows;
  std::array<HeightRow, kPaperFillings.size()> noise_free;  ///< of water only: geometric captures, without matching
};

/// What each cell is measured in.
struct HeightCapture {
  CaptureMode mode = CaptureMode::photometric;
  LightModel light = LightModel::direct;
  int trials = 1;  ///< shots
  std::uint64_t seed = 1;
};

HeightCell measure_height(const PaperFilling& filling, double distance_mm, const HeightCapture& capture);

PaperHeights measure_paper_heights(int trials, std::uint64_t seed, bool quiet);

}  // namespace fathom
