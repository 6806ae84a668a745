// usage: accuracy_sensor [PART]...
// The simulated sensor beside published figures and, where they are found, clouds that a Kinect v1 measured.
#include <fmt/format.h>

#include <array>
#include <exception>
#include <string_view>

#include "bench/accuracy.h"
#include "core/input_policy.h"

namespace fathom {
namespace {

/// Geometric captures, whose noise is drawn at random and does not come out of an image.
void compare_statistics() {
  print_title("Geometric mode with statistical noise, from here on");
  for (const auto compare : {compare_desks, compare_pots, compare_ranges, compare_edges})
    compare(CaptureMode::geometric);
}

struct SensorPart {
  std::string_view name;
  void (*compare)();
};

constexpr std::array<SensorPart, 9> kParts{{{"desks", [] { compare_desks(CaptureMode::photometric); }},
                                            {"pots", [] { compare_pots(CaptureMode::photometric); }},
                                            {"ranges", [] { compare_ranges(CaptureMode::photometric); }},
                                            {"edges", [] { compare_edges(CaptureMode::photometric); }},
                                            {"times", compare_times},
                                            {"materials", compare_materials},
                                            {"reflections", compare_reflections},
                                            {"turbid", compare_turbid},
                                            {"statistics", compare_statistics}}};

}  // namespace
}  // namespace fathom

int main(int argc, char** argv) {
  const fathom::InputPolicyScope own_files({.allow_outside = true});  // scenes name meshes that are made here
  const auto asked = [&](std::string_view name) {
    for (int i = 1; i < argc; ++i)
      if (argv[i] == name) return true;
    return argc == 1;
  };
  try {
    for (const auto& part : fathom::kParts)
      if (asked(part.name)) part.compare();
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
  return 0;
}
