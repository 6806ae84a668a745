#include "report/gnuplot_text.h"

#include <fmt/format.h>

#include "core/visible_text.h"

namespace fathom {
namespace {

/// What means nothing to gnuplot between quotation marks.
bool is_plain(char c) {
  const auto code = static_cast<unsigned char>(c);
  constexpr std::string_view kMarks = " .,:;-+=/()_";
  return code >= 0x80 || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         kMarks.find(c) != std::string_view::npos;
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  std::string literal = "\"";
  for (const char c : on_one_line(text)) {
    // In octal gnuplot reads one digit more where the first is 0.
    const int digits = c < 0100 ? 4 : 3;
    literal += is_plain(c) ? std::string(1, c) : fmt::format("\\{:0{}o}", static_cast<unsigned char>(c), digits);
  }
  return literal + '"';
}

std::string gnuplot_xtics(const std::vector<std::string>& labels) {
  std::string tics;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    std::string format;  // gnuplot takes a tic's label for the format of its number
    for (const char c : labels[i]) format += c == '%' ? "%%" : std::string(1, c);
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_text(format), i);
  }
  return fmt::format("set xtics ({}) noenhanced\n", tics);
}

}  // namespace fathom
