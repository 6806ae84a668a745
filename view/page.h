// The pages: data, three.js and the script that draws them, in one file that works without a network.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/json.h"

namespace fathom {

/// Where Debian's package libjs-three has it.
inline constexpr const char* kThreeFolder = "/usr/share/javascript/three";

/// What a page shows: its data and the script that draws them.
struct PageContent {
  Json data;
  std::string_view script;  ///< one of the three below
};

/// page.css and script/*/*.js, as they were when the program was built: a script for each kind of page, and what all
/// pages have.
extern const std::string_view kCaptureScript, kDetectionScript, kDiagnosisScript;
extern const std::string_view kCommonScript, kPageStyle;

/// `title` is plain text. Throws Error naming the file of three.js that is missing in `three`.
std::string view_page(std::string_view title, const PageContent& content, const std::filesystem::path& three);

}  // namespace fathom
