// The border to OpenNI2's C interface: no exception crosses it; its line goes where clients look for it.
#pragma once

#include <Driver/OniDriverAPI.h>

#include <exception>

namespace fathom {

/// Runs `work`. When it throws, what() becomes OpenNI::getExtendedError() and `failed` is returned.
template <class Result, class Work>
Result guarded(oni::driver::DriverServices& services, Result failed, Work work) {
  try {
    return work();
  } catch (const std::exception& problem) {
    services.errorLoggerAppend("%s", problem.what());
    return failed;
  }
}

}  // namespace fathom
