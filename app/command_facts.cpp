#include "app/command_facts.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

namespace fathom {
namespace {

/// "{a,b}" as its words.
std::vector<std::string> words_of_set(std::string_view set) {
  std::vector<std::string> words;
  set.remove_prefix(1);
  for (std::size_t end = 0; (end = set.find_first_of(",}")) != std::string_view::npos; set.remove_prefix(end + 1))
    words.emplace_back(set.substr(0, end));
  return words;
}

OptionFacts facts_of(const CLI::Option& option) {
  OptionFacts facts;
  facts.standard = option.get_default_str();
  facts.help = option.get_description();
  facts.is_positional = option.get_positional();
  facts.is_required = option.get_required();
  facts.is_list = option.get_items_expected_max() > 1;
  for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
  if (facts.is_positional) facts.names = {option.get_name(true)};
  if (option.get_items_expected_max() == 0) return facts;
  const std::string type = option.get_type_name();  // with what its checks say of themselves, after a colon
  const std::size_t colon = type.find(':');
  facts.value = type.substr(0, colon);
  if (colon == std::string::npos) return facts;
  facts.allowed = type.substr(colon + 1);
  if (facts.allowed.starts_with('{')) {
    facts.choices = words_of_set(facts.allowed);
    facts.allowed.clear();
  }
  return facts;
}

}  // namespace

bool OptionFacts::names_folder() const { return value.ends_with("DIR"); }

bool OptionFacts::is_number() const {
  constexpr std::array kNumbers{"INT", "UINT", "FLOAT", "FLOAT,…", "FLOAT|inf", "MM", "DEG", "PX", "S"};
  return std::find(kNumbers.begin(), kNumbers.end(), value) != kNumbers.end();
}

CommandFacts facts_of(const CLI::App& command, const std::string& name) {
  CommandFacts facts{name, command.get_description(), command.get_footer(), {}, {}};
  for (const CLI::Option* option : command.get_options()) facts.options.push_back(facts_of(*option));
  for (const CLI::App* below : command.get_subcommands({})) {
    facts.commands.push_back(facts_of(*below, name + " " + below->get_name()));
    if (!below->get_fallthrough()) continue;
    for (const OptionFacts& option : facts.options)
      if (option.names.back() != "--help") facts.commands.back().options.push_back(option);
  }
  return facts;
}

std::vector<const CommandFacts*> all_commands(const CommandFacts& top) {
  std::vector<const CommandFacts*> all{&top};
  for (const CommandFacts& command : top.commands)
    for (const CommandFacts* below : all_commands(command)) all.push_back(below);
  return all;
}

}  // namespace fathom
