// Sets of effects weighed against the data and each other: what passes all tests, what it leaves, what stays open.
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/case.h"
#include "diagnosis/statistics/choose.h"

namespace fathom {

struct Weighed {
  std::vector<Option> options;   ///< that no test rejects
  std::optional<Choice> choice;  ///< what passes all tests
  Refit fit;                     ///< the choice's, or that of no effects
  Rest rest;                     ///< what the fit leaves
  double p_rest = 1.0;           ///< of that, or of what the likeliest set leaves, if errors alone rather make that
  bool is_rest = false;          ///< whether even the likeliest set leaves something
};

Weighed weigh(const Case& c);

}  // namespace fathom
