// Pictures by gnuplot, which runs as a program of its own.
#pragma once

#include <filesystem>
#include <string>

namespace fathom {

/// For work that ends in a picture, before it starts. Throws Error when gnuplot is missing.
void require_gnuplot();

/// Writes folder/NAME.gp: the house's style, then `plot` (which ends with one plot command and names its data files
/// relative to the folder), for NAME.png and NAME.svg; and runs it. Throws Error when gnuplot is missing or fails;
/// pictures that are there already then stay. Every string of `plot` that is no constant is gnuplot_text(). What
/// `before_svg` sets is for the SVG alone, whose letters its viewer draws.
void draw(const std::filesystem::path& folder, const std::string& name, const std::string& plot,
          const std::string& before_svg = "");

/// Removes what draw() left, NAME.gp last. Files of these names beside which no script of draw() lies stay.
void remove_drawing(const std::filesystem::path& folder, const std::string& name);

}  // namespace fathom
