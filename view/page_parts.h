// The pages' own page.css and script/*/*.js, as they were when the program was built.
#pragma once

#include <string_view>

namespace fathom {

extern const std::string_view kPageStyle;
extern const std::string_view kCommonScript;
extern const std::string_view kCaptureScript, kDetectionScript,
    kDiagnosisScript;  ///< of each page, after the common one

}  // namespace fathom
