// Strings of gnuplot's scripts. Gnuplot runs commands that it finds in a string in backquotes or behind a quotation
// mark, so every string that is not a constant of the script goes through here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fathom {

/// A text of any characters as a literal, quotation marks included: nothing in it can be a command, and the string that
/// gnuplot reads is visible_text() of the text without line feeds. Where it is drawn, "noenhanced" shows it as written.
std::string gnuplot_text(std::string_view text);

/// The command that writes these labels along the x axis, at 0, 1 and so on, as they are written. Gnuplot cuts those
/// that hold a "%" after 49 bytes.
std::string gnuplot_xtics(const std::vector<std::string>& labels);

}  // namespace fathom
