// What goes to the terminal. Text from files carries no control characters there.
#pragma once

#include <string_view>

namespace fathom {

/// Lines on stdout, in JSON too: control characters are written as JSON writes it.
void print_text(std::string_view text);

/// One line on stderr: "warning: " or "note: " and the sentence.
void print_warning(std::string_view sentence);
void print_note(std::string_view sentence);

}  // namespace fathom
