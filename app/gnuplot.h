// Pictures by gnuplot, which runs as a program of its own.
#pragma once

#include <filesystem>
#include <string>

namespace fathom {

/// Writes folder/NAME.gp: the house's style, then `plot` (which ends with one plot command and names its data files
/// relative to the folder), for NAME.png and NAME.svg; and runs it. Throws Error when gnuplot is missing or fails.
void draw(const std::filesystem::path& folder, const std::string& name, const std::string& plot);

}  // namespace fathom
