#include "app/print.h"

#include <fmt/format.h>

#include "core/standard_streams.h"
#include "core/visible_text.h"

namespace fathom {

void print_text(std::string_view text) { fmt::print("{}", visible_text(text)); }

void print_status(std::string_view sentence) { say(fmt::format("{}\n", on_one_line(sentence))); }

void print_warning(std::string_view sentence) { say(fmt::format("warning: {}\n", on_one_line(sentence))); }

void print_note(std::string_view sentence) { say(fmt::format("note: {}\n", on_one_line(sentence))); }

}  // namespace fathom
