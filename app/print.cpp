#include "app/print.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/visible_text.h"

namespace fathom {

void print_text(std::string_view text) { fmt::print("{}", visible_text(text)); }

void print_warning(std::string_view sentence) { fmt::print(stderr, "warning: {}\n", on_one_line(sentence)); }

void print_note(std::string_view sentence) { fmt::print(stderr, "note: {}\n", on_one_line(sentence)); }

}  // namespace fathom
