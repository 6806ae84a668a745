// Book-keeping that went wrong, as far as observations and predictions show it: looked for before any physics.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

/// One sentence for each finding: a unit (heights off by a power of ten or an inch), labels of two pours that fit far
/// better exchanged, a lateral axis that fits far better mirrored, a pour that alone is a cup's difference off, two
/// placements with identical numbers, cups that all stand where a colour camera would see them.
std::vector<std::string> hygiene_warnings(const Evidence& evidence);

}  // namespace fathom
