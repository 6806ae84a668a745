#include "app/detector_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/number_option.h"
#include "core/error.h"
#include "core/units.h"

namespace fathom {

std::optional<DeskPrior> DeskOptions::prior() const {
  if (!given) return std::nullopt;
  return DeskPrior{metres_from_mm(height_mm), radians_from_deg(pitch_deg)};
}

void add_desk_options(CLI::App& app, DeskOptions& options) {
  CLI::Option* height = app.add_option("--height-mm", options.height_mm, "Height of the sensor above the desk")
                            ->check(number_within({1.0, 1e5}))
                            ->type_name("MM");
  CLI::Option* pitch =
      app.add_option("--pitch-deg", options.pitch_deg, "0: the sensor looks horizontally, 90: straight down")
          ->check(number_within({-90.0, 90.0}))
          ->type_name("DEG")
          ->each([&options](const std::string&) { options.given = true; });
  height->needs(pitch);
  pitch->needs(height);
}

void add_method_option(CLI::App& app, std::string& method) {
  std::vector<std::string> names;
  std::string help = "One of";
  for (const Method& one : methods()) {
    names.emplace_back(one.name);
    help += fmt::format(" {} ({})", one.name, one.summary);
  }
  app.add_option("--method", method, help)->capture_default_str()->check([names](const std::string& name) {
    const bool known = std::find(names.begin(), names.end(), name) != names.end();
    return known ? std::string() : unknown_name("method", name, names);
  });
}

}  // namespace fathom
