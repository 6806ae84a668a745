// Why an effect that shows is not confirmed: it shows in too few groups that could be set against each other.
#pragma once

#include "diagnosis/statistics/ambiguity.h"
#include "diagnosis/statistics/covariance.h"
#include "diagnosis/statistics/diagnosis.h"

namespace fathom {

/// What would have to be measured again for an option's effects to show in groups that have no part in each other's
/// choices. Sessions where no session has more than two placements that tell of them, else pours where that few are,
/// else nothing.
Anew lacks_anew(const Evidence& evidence, const Covariance& covariance, const Option& option);

}  // namespace fathom
