#include "app/shard.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "app/command.h"

namespace fathom {

void add_shard_option(CLI::App& app, std::string& shard) {
  app.add_option("--shard", shard, "Only the i-th of n parts: every process of n makes one, on one machine or many")
      ->type_name("i/n")
      ->capture_default_str();
}

Shard shard_of(const std::string& text) {
  Shard shard{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%6d/%6d%c", &shard.number, &shard.count, &rest) != 2 || shard.count < 1 ||
      shard.number < 0 || shard.number >= shard.count)
    throw UsageError(fmt::format("--shard must be i/n with i from 0 to n-1, got {}", text));
  return shard;
}

}  // namespace fathom
