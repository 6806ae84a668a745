// The options that every command with a detector shares.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "detector/detector.h"

namespace CLI {
class App;
}

namespace fathom {

/// --height-mm and --pitch-deg; both or neither.
struct DeskOptions {
  double height_mm = 0.0;
  double pitch_deg = 0.0;
  bool given = false;

  std::optional<DeskPrior> prior() const;
};

void add_desk_options(CLI::App& app, DeskOptions& options);

/// --method, one of the table's.
void add_method_option(CLI::App& app, std::string& method);

}  // namespace fathom
