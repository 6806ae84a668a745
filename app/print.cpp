#include "app/print.h"

#include <fmt/format.h>

#include "core/standard_streams.h"
#include "core/visible_text.h"

namespace fathom {

void print_text(std::string_view text) { print_result(visible_text(text)); }

namespace {

/// A message may quote a file's line of a megabyte.
std::string readable(std::string_view message) {
  constexpr std::size_t kMost = 2000;  // [bytes]
  if (message.size() <= kMost) return on_one_line(message);
  std::size_t size = kMost;
  while (size > 0 && (message[size] & 0xC0) == 0x80) --size;  // not within a character
  return on_one_line(message.substr(0, size)) + " …";
}

}  // namespace

void print_error(std::string_view message, std::string_view below) {
  say(fmt::format("error: {}\n{}", readable(message), below));
}

void print_status(std::string_view sentence) { say(fmt::format("{}\n", on_one_line(sentence))); }

void print_warning(std::string_view sentence) { say(fmt::format("warning: {}\n", on_one_line(sentence))); }

void print_note(std::string_view sentence) { say(fmt::format("note: {}\n", on_one_line(sentence))); }

}  // namespace fathom
