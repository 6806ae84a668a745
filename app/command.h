// A command of the program: its row in the table of commands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string_view>

namespace CLI {
class App;
}

namespace fathom {

/// Options that every command has.
struct CommonOptions {
  std::filesystem::path output;  ///< of -o; empty when not given
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: all
  bool quiet = false;
  bool json = false;
  int max_input_mb = 1000;     ///< of memory that one file may claim
  bool allow_outside = false;  ///< files may name others outside their folder
};

/// The command line asks for something that cannot be: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// For commands that do not need -o in any case, where they need it. Throws UsageError when it is missing.
inline void require_output(const CommonOptions& common) {
  if (common.output.empty()) throw UsageError("-o DIR is required");
}

/// A function that adds a command's own options to `app` and returns what runs it. `common` is filled when the run
/// starts.
using Define = std::function<void()>(CLI::App& app, const CommonOptions& common);

struct Command {
  std::string_view name;
  std::string_view summary;   ///< one line for `fathom --help`
  std::string_view examples;  ///< lines that run as they stand, shown under `fathom NAME --help`
  Define* define;
  bool needs_output = false;        ///< whether -o is required in any case
  std::string_view output = "DIR";  ///< what -o names: DIR or FILE
};

inline constexpr bool kNeedsOutput = true;

}  // namespace fathom
