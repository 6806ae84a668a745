#include "core/input_policy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>

#include "core/error.h"

namespace fathom {
namespace fs = std::filesystem;

namespace {

InputPolicy& in_force() {
  static InputPolicy policy;
  return policy;
}

/// Names come from files: what would break a line is not shown.
std::string shown(std::string name) {
  constexpr std::size_t kMost = 200;
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return name.size() > kMost ? name.substr(0, kMost) + "…" : name;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [of_folder, of_path] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return of_folder == folder.end() && of_path != path.end();
}

}  // namespace

std::string size_text(double bytes) {
  constexpr std::array kUnits{"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit + 1 < kUnits.size(); ++unit) bytes /= 1000.0;
  return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

const InputPolicy& input_policy() { return in_force(); }

InputPolicyScope::InputPolicyScope(const InputPolicy& policy) : before_(in_force()) { in_force() = policy; }
InputPolicyScope::~InputPolicyScope() { in_force() = before_; }

std::uint64_t bytes_of(std::initializer_list<std::uint64_t> factors) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t product = 1;
  for (const std::uint64_t factor : factors) {
    if (factor == 0) return 0;
    product = product > kMost / factor ? kMost : product * factor;
  }
  return product;
}

void require_within_limit(std::string_view file, std::string_view where, std::uint64_t bytes, std::string_view things) {
  const std::uint64_t most = input_policy().most_bytes;
  if (bytes <= most) return;
  const std::string what =
      fmt::format("promises {} of {}, at most {} is read; raise it with --max-input-mb",
                  size_text(static_cast<double>(bytes)), things, size_text(static_cast<double>(most)));
  if (where.empty()) throw Error(file, what);
  throw Error(file, where, what);
}

fs::path path_named_in(const std::string& file, std::string_view where, const std::string& name) {
  if (name.empty() || name.find('\0') != std::string::npos)
    throw Error(file, where, fmt::format("must be a file's name, got '{}'", shown(name)));
  const fs::path folder = fs::path(file).parent_path(), path = folder / name;
  if (input_policy().allow_outside) return path;
  const auto refuse = [&](std::string_view why) {
    throw Error(file, where, fmt::format("names '{}', which {}; --allow-outside allows it", shown(name), why));
  };
  if (fs::path(name).is_absolute()) refuse("is an absolute path");
  // Absolute first: of a path that does not exist weakly_canonical() leaves the beginning out.
  std::error_code problem;
  const fs::path real_folder = fs::weakly_canonical(fs::absolute(folder.empty() ? fs::path(".") : folder), problem);
  const fs::path real_path = problem ? fs::path() : fs::weakly_canonical(fs::absolute(path), problem);
  if (problem) throw Error(file, where, fmt::format("names '{}': {}", shown(name), problem.message()));
  if (!is_below(real_path, real_folder)) refuse("lies outside the folder of the file that names it");
  return path;
}

}  // namespace fathom
