// The options that every command with a detector shares, and the detector's configuration file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/json.h"
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

/// Two rising lengths [low, high] in mm, if the key is there.
void read_mm_range(const JsonReader& json, std::string_view key, double& low_m, double& high_m);

/// Reads the keys of config.json over the defaults; the templates are those it names (beside the file), else those that
/// come with the program. An empty path gives the defaults. Throws Error on anything unknown or out of range.
DetectorSettings detector_settings(const std::filesystem::path& config);

}  // namespace fathom
