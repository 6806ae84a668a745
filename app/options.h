// Options that several commands share, and checks of their values.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/range.h"
#include "datasets/generate.h"
#include "detector/detector.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace fathom {

/// For CLI::Option::check. Help and completions show the names; an error says which one is near.
CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& names);

/// For CLI::Option::check: empty when the text is a finite number of the range, else what must be. CLI11's own checks
/// let NaN pass.
std::function<std::string(const std::string&)> number_within(Range range);

/// An option that takes numbers of the range, separated by commas or blanks. CLI11's own lists drop what is empty.
void add_number_list(CLI::App& app, const char* name, std::vector<double>& values, const char* what, Range range);

/// Makes every option that takes a number, of the command and of those below it, refuse text that is none and numbers
/// that do not fit: CLI11 takes an empty text for 0, cuts a whole number that is too large to the largest one, and
/// reads 010 as 8. These options are known by CLI11's names of their types, INT, UINT and FLOAT; one with another
/// type_name() needs number_within(). Called once, when all options are there.
void require_numbers(CLI::App& command);

/// The argument of commands that read one measurement directory; filled when the run starts. One that is not required
/// may stay empty.
std::shared_ptr<std::filesystem::path> add_measurement_folder(CLI::App& app, bool is_required = true);

/// --height-mm and --pitch-deg; both or neither.
struct DeskOptions {
  double height_mm = 0.0;
  double pitch_deg = 0.0;
  bool given = false;

  std::optional<DeskPrior> prior() const;
};

void add_desk_options(CLI::App& app, DeskOptions& options);

/// --method: the name of one of the detector's methods().
void add_method_option(CLI::App& app, std::string& method);

inline constexpr const char* kWhole = "0/1";  ///< of --shard: all of the work

/// --shard i/n: the part of the work that one of many processes does.
void add_shard_option(CLI::App& app, std::string& shard);

/// "3/8": the fourth of eight. Throws UsageError.
Shard shard_of(const std::string& text);

}  // namespace fathom
