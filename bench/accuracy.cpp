#include "bench/accuracy.h"

#include <fmt/format.h>

namespace fathom {

void print_title(std::string_view title) {
  fmt::print("\n{}\n{:<46} {:>10} {:>10}  {:<18} {:>15}\n", title, "", "simulated", "other", "", "bar");
}

void print_figure(std::string_view what, double simulated, std::optional<double> other, std::string_view source,
                  std::optional<Bar> bar) {
  const std::string beside = other ? fmt::format("{:.3f}", *other) : "";
  fmt::print("{:<46} {:>10.3f} {:>10}  {:<18}", what, simulated, beside, source);
  if (bar)
    fmt::print(" {:>15}  {}", fmt::format("{:.3f}…{:.3f}", bar->low, bar->high),
               simulated >= bar->low && simulated <= bar->high ? "met" : "MISSED");
  fmt::print("\n");
}

void print_note(std::string_view note) { fmt::print("  {}\n", note); }

}  // namespace fathom
