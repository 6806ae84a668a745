// usage: accuracy_sensor [PART]...
// The simulated sensor beside published figures and, where they are found, clouds that a Kinect v1 measured.
#include <fmt/format.h>

#include <array>
#include <exception>
#include <string_view>

#include "bench/accuracy.h"

namespace {

struct Part {
  std::string_view name;
  void (*compare)();
};

constexpr std::array<Part, 6> kParts{{{"desks", fathom::compare_desks},
                                      {"pots", fathom::compare_pots},
                                      {"ranges", fathom::compare_ranges},
                                      {"edges", fathom::compare_edges},
                                      {"times", fathom::compare_times},
                                      {"materials", fathom::compare_materials}}};

}  // namespace

int main(int argc, char** argv) {
  const auto asked = [&](std::string_view name) {
    for (int i = 1; i < argc; ++i)
      if (argv[i] == name) return true;
    return argc == 1;
  };
  try {
    for (const Part& part : kParts)
      if (asked(part.name)) part.compare();
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
  return 0;
}
