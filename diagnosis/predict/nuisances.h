// What is uncertain in a campaign and is no effect, with what it does to the observations.
#pragma once

#include "diagnosis/predict/predictor.h"

namespace fathom {

/// The rig's uncertain values (1 σ from the rig, else the usual of kRigValues), the sensor's pose in each session where
/// there are several, the fill of every pour, and the place of every placement.
std::vector<Nuisance> nuisances_of(const Predictor& predictor);

/// How the names of patterns of the unit's bias begin.
inline constexpr std::string_view kUnitPattern = "bias of the unit, pattern";

/// What is left to know of the unit's bias, once it was learned; of heights that a table holds the whole of it, at each
/// place of the cup.
std::vector<Nuisance> unit_nuisances(const Predictor& predictor, const std::vector<Observation>& observations);

/// Widths of the window, in pixels of the depth image, over which disparities are as good as averaged: none, and a
/// device's. A device's blocks are 9 pixels wide; dots' own width and the images' gradients make 12 of them
/// (bench/matching_window.py, on surfaces that bend as gently as a bottom under water).
inline constexpr double kNoWindow_px = 1.0, kDeviceWindow_px = 12.0;

/// What windows of a device's width change, with a σ of half of it: predictions are to lie in the middle, 1 σ from
/// clouds that have averaged over such windows and 1 σ from clouds that have not.
Nuisance usual_windows(const Predictor& predictor);

/// How much of that middle is left where effects may say how wide windows are: 1 to 0.
double left_to_usual_windows(const std::vector<EffectValue>& effects);

/// What recorded the brightness need not have been linear: an exponent of 1 ± 0.5 (encodings for screens have 1 / 2.2)
/// on all that is `predicted` of it.
Nuisance brightness_response(const std::vector<Observation>& observations, const Eigen::VectorXd& predicted);

}  // namespace fathom
