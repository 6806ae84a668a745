// Text of any origin as it may be shown: on terminals, in pictures and pages.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace fathom {

/// The text with its control characters, but for line feeds and tabs, written as JSON writes them ("\u001b"), and bytes
/// that are no UTF-8 as "\xfc". Terminals obey control characters; SVG and HTML must not hold them.
std::string visible_text(std::string_view text);

/// visible_text(), with line feeds and tabs written in the same way.
std::string on_one_line(std::string_view text);

/// Likewise, with all characters that cannot be shown.
std::string on_one_line(std::string_view text, const std::function<bool(char32_t)>& can_show);

}  // namespace fathom
