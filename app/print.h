// What goes to the terminal. Text from files carries no control characters there.
#pragma once

#include <string_view>

namespace fathom {

/// Lines on stdout. Control characters are written as JSON writes them, in text that is no JSON as well.
void print_text(std::string_view text);

/// One line on stderr, of what is going on.
void print_status(std::string_view sentence);

/// One line on stderr and what stands `below` it. The line is cut after 2,000 bytes: it may quote a file's line of a
/// megabyte.
void print_error(std::string_view message, std::string_view below = "");

/// One line on stderr: "warning: " or "note: " and the sentence.
void print_warning(std::string_view sentence);
void print_note(std::string_view sentence);

}  // namespace fathom
