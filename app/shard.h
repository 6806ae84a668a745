// --shard i/n: the part of the work that one of many processes does.
#pragma once

#include <chrono>
#include <string>

namespace CLI {
class App;
}

namespace fathom {

/// The part `number`, from 0, of `count`.
struct Shard {
  int number, count;
};

inline constexpr const char* kWhole = "0/1";

/// How long a process waits for the folder that all of them share.
inline constexpr std::chrono::seconds kShardPatience(600);

void add_shard_option(CLI::App& app, std::string& shard);

/// "3/8": the fourth of eight. Throws UsageError.
Shard shard_of(const std::string& text);

}  // namespace fathom
