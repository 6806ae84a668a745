// What observables and conditions are called, and which way observables may be off.
#pragma once

#include <string>
#include <string_view>

#include "diagnosis/statistics/evidence.h"

namespace fathom {

struct ObservableWords {
  std::string_view id, name, unit;
  std::string_view more, less;  ///< what it is than the model has it, where it is larger and where it is smaller
};

/// Of an observable of diagnosis/measurement; of another its id, in no unit, "larger" or "smaller".
ObservableWords observable_words(std::string_view id);

/// "water, 20 mm, cup at (80, 200) mm"
std::string spaced(std::string_view name);  ///< "milk_tea" → "milk tea"
std::string condition_words(const Factors& factors);

}  // namespace fathom
