// Whether a picture that another program wrote is all there. Gnuplot does not notice a full disk.
#pragma once

#include <filesystem>
#include <string_view>

namespace fathom {

/// Every element of the text is closed, <svg> last.
bool is_whole_svg(std::string_view text);

/// By its extension, .png or .svg.
bool is_whole_picture(const std::filesystem::path& path);

}  // namespace fathom
