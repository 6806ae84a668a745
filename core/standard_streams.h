// The program's own input and output, which may be closed, full or gone.
#pragma once

#include <string_view>

namespace fathom {

/// Call first. Where a standard stream is closed, the next file that is opened would take its number, and what is
/// printed would go into that file. Closed ones become ones that fail.
void occupy_standard_streams();

/// Writes to stderr. Where nobody can be told any more, nothing happens: fmt::print would throw, out of a handler of
/// errors even.
void say(std::string_view text) noexcept;

/// The same for a line without its end, whose place the next text takes.
void say_progress(std::string_view text) noexcept;

void clear_progress() noexcept;

/// Writes to stdout, on a terminal never into the line of the progress. Throws std::system_error where it cannot.
void print_result(std::string_view text);

}  // namespace fathom
