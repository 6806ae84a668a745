#include "app/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>

#include "app/command.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/units.h"

namespace fathom {
namespace {

/// The texts between the commas of a list of numbers, empty ones too.
std::vector<std::string> parts(const std::string& text) {
  std::vector<std::string> result(1);
  for (const char c : text)
    if (c == ',')
      result.emplace_back();
    else
      result.back() += c;
  return result;
}

/// Writes a whole number as CLI11 reads it: 010 as 10, since CLI11 would take it for an octal one.
template <class Whole>
std::string whole_number(std::string& text) {
  const std::optional<Whole> number = decimal<Whole>(text);
  if (!number)
    return fmt::format("must be a whole number{}, got '{}'",
                       std::numeric_limits<Whole>::is_signed
                           ? std::string()
                           : fmt::format(" from 0 to {}", std::numeric_limits<Whole>::max()),
                       text);
  text = fmt::to_string(*number);
  return {};
}

std::string any_number(const std::string& text) { return number_within({})(text); }

}  // namespace

CLI::Validator one_of(const std::string& kind, const std::vector<std::string>& names) {
  const auto wrong = [kind, names](const std::string& name) {
    const bool known = std::find(names.begin(), names.end(), name) != names.end();
    return known ? std::string() : unknown_name(kind, name, names);
  };
  return {wrong, fmt::format("{{{}}}", fmt::join(names, ",")), kind};
}

std::function<std::string(const std::string&)> number_within(Range range) {
  return [range](const std::string& text) {
    const std::optional<double> number = decimal<double>(text);
    return number && range.contains(*number) ? std::string() : fmt::format("must be {}, got '{}'", range.text(), text);
  };
}

void add_number_list(CLI::App& app, const char* name, std::vector<double>& values, const char* what, Range range) {
  constexpr int kMost = 1000;  // words of one list; so few that CLI11 does not look for brackets around them
  const auto take = [&values](const std::vector<std::string>& words) {
    values.clear();
    for (const std::string& word : words)
      for (const std::string& part : parts(word)) values.push_back(*decimal<double>(part));
  };
  app.add_option_function<std::vector<std::string>>(name, take, what)
      ->expected(1, kMost)
      ->allow_extra_args(false)
      ->type_name("FLOAT,…")
      ->default_str(fmt::format("{}", fmt::join(values, ",")))
      ->check([wrong = number_within(range)](const std::string& word) {
        for (const std::string& part : parts(word))
          if (const std::string problem = wrong(part); !problem.empty()) return problem;
        return std::string();
      });
}

void require_numbers(CLI::App& command) {
  for (CLI::Option* option : command.get_options([](const CLI::Option*) { return true; })) {
    const std::string name = option->get_type_name();  // with what its checks say of themselves, after a colon
    const std::string type = name.substr(0, name.find(':'));
    // Whole numbers ahead of the other checks, which read them as well; others after their ranges, which say more.
    if (type == "UINT") option->transform(CLI::Validator(whole_number<std::uint64_t>, ""));
    if (type == "INT") option->transform(CLI::Validator(whole_number<std::int64_t>, ""));
    if (type == "FLOAT") option->check(any_number);
  }
  for (CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; })) require_numbers(*below);
}

std::shared_ptr<std::filesystem::path> add_measurement_folder(CLI::App& app, bool is_required) {
  auto folder = std::make_shared<std::filesystem::path>();
  app.add_option("folder", *folder, "Measurement directory: rig.json, frames.csv and clouds")
      ->required(is_required)
      ->type_name("DIR");
  return folder;
}

std::optional<DeskPrior> DeskOptions::prior() const {
  if (!given) return std::nullopt;
  return DeskPrior{metres_from_mm(height_mm), radians_from_deg(pitch_deg)};
}

void add_desk_options(CLI::App& app, DeskOptions& options) {
  CLI::Option* height = app.add_option("--height-mm", options.height_mm, "Height of the sensor above the desk")
                            ->check(number_within({1.0, 1e5}))
                            ->type_name("MM");
  CLI::Option* pitch =
      app.add_option("--pitch-deg", options.pitch_deg, "0: the sensor looks horizontally, 90: straight down")
          ->check(number_within({-90.0, 90.0}))
          ->type_name("DEG")
          ->each([&options](const std::string&) { options.given = true; });
  height->needs(pitch);
  pitch->needs(height);
}

void add_method_option(CLI::App& app, std::string& method) {
  std::vector<std::string> names;
  std::string help = "One of";
  for (const Method& one : methods()) {
    names.emplace_back(one.name);
    help += fmt::format(" {} ({})", one.name, one.summary);
  }
  app.add_option("--method", method, help)->capture_default_str()->check(one_of("method", names));
}

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
