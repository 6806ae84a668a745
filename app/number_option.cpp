#include "app/number_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/decimal.h"

namespace fathom {
namespace {

/// What parts a list of numbers; an empty text between two of them is a part as well.
std::vector<std::string> parts(const std::string& text) {
  std::vector<std::string> result(1);
  for (const char c : text)
    if (c == ',')
      result.emplace_back();
    else
      result.back() += c;
  return result;
}

/// Puts a whole number as CLI11 reads it: without what it takes for an octal one.
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

}  // namespace fathom
