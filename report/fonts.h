// Which characters can be drawn here.
#pragma once

#include <string>
#include <string_view>

namespace fathom {

/// on_one_line(), with characters that no font of this machine has written as "\u725b": Cairo draws a box for each that
/// covers the picture.
std::string drawable_text(std::string_view text);

}  // namespace fathom
