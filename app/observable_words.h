// What observables are called, and which way they may be off.
#pragma once

#include <string>
#include <string_view>

namespace fathom {

struct ObservableWords {
  std::string_view id, name, unit;
  std::string_view more, less;  ///< what it is than the model has it, where it is larger and where it is smaller
};

/// Of an observable of diagnosis/measurement; of another its id, in no unit, "larger" or "smaller".
ObservableWords observable_words(std::string_view id);

}  // namespace fathom
