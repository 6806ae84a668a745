// --shard i/n: the part of the work that one of many processes does.
#pragma once

#include <string>

#include "datasets/generate.h"

namespace CLI {
class App;
}

namespace fathom {

inline constexpr const char* kWhole = "0/1";

void add_shard_option(CLI::App& app, std::string& shard);

/// "3/8": the fourth of eight. Throws UsageError.
Shard shard_of(const std::string& text);

}  // namespace fathom
