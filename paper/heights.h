// The paper's table, cup and sensor, where its text says so, and our assumptions where it does not; and the measurement
// behind Fig. 5 and Fig. 14: the height in the cup for a filling and a distance.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "diagnosis/measurement/laboratory_rig.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"

namespace fathom {

struct PaperFilling {
  std::string liquid;  ///< "empty" or a name from scenes/media
  double fill_mm;

  std::string label() const;  ///< "milk tea 30 mm"
};

inline constexpr double kPaperIndex = 1.333;     ///< "the relative refractive index 1.333 of water to air"
inline constexpr double kPaperHeightMm = 650.0;  ///< of the sensor above the desk: an assumption
inline constexpr double kPaperBottomMm = 7.0;    ///< of the cup, above the desk: an assumption

/// The paper's milk tea reads "approximately 1–2 mm lower than the actual height", which is of a fill by hand.
inline constexpr double kPrintedLeastLowMm = 1.0, kPrintedMostLowMm = 2.0, kFillSigmaMm = 1.0;

/// The cup on the sensor's middle line, the sensor aimed at (0, 400 mm, 0). `sensor`: keys of a scene's "sensor" that
/// are otherwise than in the paper.
Setup paper_setup(const PaperFilling& filling, double distance_mm, const Json& sensor = Json::object());

LaboratoryRig paper_rig(const Setup& setup);

/// Of water, at the sensor's wavelength.
double water_index_at_sensor();

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
