// What a measurement directory lacks, in words: what it is, what that costs, and what helps.
#pragma once

#include <string>
#include <string_view>

#include "diagnosis/measurement/check.h"

namespace fathom {

struct LackWords {
  std::string_view id;
  std::string what, costs, remedy;  ///< a sentence each
};

LackWords lack_words(const Shortfall& shortfall, const MeasurementCheck& check);

}  // namespace fathom
