#include "core/visible_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace fathom {
namespace {

struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;  ///< 0: no UTF-8 begins here
};

/// The first character of a text that is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t bytes = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < bytes) return {};
  char32_t code = byte(0) & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast[bytes] || code > 0x10FFFF || is_surrogate) return {};
  return {code, bytes};
}

/// C0, DEL, C1, and the two that XML forbids.
bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0xFFFE || code == 0xFFFF;
}

std::string shown(std::string_view text, const std::function<bool(char32_t)>& can_show) {
  std::string result;
  while (!text.empty()) {
    const auto [code, bytes] = first_character(text);
    if (bytes == 0)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    else if (can_show(code))
      result += text.substr(0, bytes);
    else
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return result;
}

}  // namespace

std::string visible_text(std::string_view text) {
  return shown(text, [](char32_t code) { return code == '\n' || code == '\t' || !is_control(code); });
}

std::string on_one_line(std::string_view text) {
  return shown(text, [](char32_t code) { return !is_control(code); });
}

std::string on_one_line(std::string_view text, const std::function<bool(char32_t)>& can_show) {
  return shown(text, [&](char32_t code) { return !is_control(code) && can_show(code); });
}

}  // namespace fathom
