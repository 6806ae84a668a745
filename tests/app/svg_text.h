// What is to be read in a picture by gnuplot.
#pragma once

#include <string>
#include <string_view>

#include "core/visible_text.h"

namespace fathom {

/// Whether a text stands in the picture as it is written, in one piece.
inline bool shows(std::string_view svg, std::string_view text) {
  std::string escaped = ">";
  for (const char c : on_one_line(text)) escaped += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return svg.find(escaped + "</text>") != std::string_view::npos;
}

}  // namespace fathom
