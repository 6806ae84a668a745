// Which observations of a campaign a model of direct light can be held against.
#pragma once

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// Heights by region, the brightness and the dots' contrast inside and the desk's height in every placement; how the
/// desk lies and looks once in a session, with bare desk and with a cup: it stays where it is, so that the placements
/// of a session are repeats of it, and what they scatter by is its error. Left out are spreads and valid fractions,
/// which walls, scattering and matching decide, and the combs where depths were recorded in other units than the
/// device's whole millimetres. Those of the device's own steps and of the infrared image only help to name
/// (`only_names`): processing takes such steps away, and albedos are nobody's to know. Steps that are coarser than the
/// device's count like heights: no processing makes them.
std::vector<Observation> predictable(const std::vector<Observation>& observations);

}  // namespace fathom
