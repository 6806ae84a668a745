// What files that others have made may claim: memory, and other files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace fathom {

struct InputPolicy {
  std::uint64_t most_bytes = 1'000'000'000;  ///< of memory that one file may claim, decoded; --max-input-mb
  bool allow_outside = false;                ///< whether a file may name others outside its folder; --allow-outside
};

/// The policy in force.
const InputPolicy& input_policy();

/// Puts a policy in force for the whole process while it lives, as tbb::global_control does. The one before returns
/// with its end. No other thread may read files while a scope begins or ends.
class InputPolicyScope {
 public:
  explicit InputPolicyScope(const InputPolicy& policy);
  ~InputPolicyScope();
  InputPolicyScope(const InputPolicyScope&) = delete;
  InputPolicyScope& operator=(const InputPolicyScope&) = delete;

 private:
  InputPolicy before_;
};

/// "13.7 GB": three digits, in units of powers of a thousand.
std::string size_text(double bytes);

/// The product, or the largest number there is where it is larger: sizes out of headers multiply beyond any type.
std::uint64_t bytes_of(std::initializer_list<std::uint64_t> factors);

/// To be asked before memory is claimed. Throws Error "FILE: WHERE: promises 13.7 GB of pixels, at most 1 GB is read;
/// raise it with --max-input-mb" where `bytes` of `things` are more than the policy allows; `where` may be empty.
void require_within_limit(std::string_view file, std::string_view where, std::uint64_t bytes, std::string_view things);

/// The path of a file whose name stands in `file` at `where`; every such name goes through here. Relative names start
/// at the folder of `file`. Throws Error where the name is empty, absolute or leaves that folder, by ".." or by a
/// symbolic link, unless the policy allows it. The file need not exist.
std::filesystem::path path_named_in(const std::string& file, std::string_view where, const std::string& name);

}  // namespace fathom
