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

}  // namespace fathom
