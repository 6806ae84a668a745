// The argument of commands that read one measurement directory.
#pragma once

#include <filesystem>
#include <memory>

namespace CLI {
class App;
}

namespace fathom {

/// Adds it; it is filled when the run starts. One that is not required may stay empty.
std::shared_ptr<std::filesystem::path> add_measurement_folder(CLI::App& app, bool is_required = true);

}  // namespace fathom
