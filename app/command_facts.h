// What a command takes, read off CLI11, and what is written of that: man pages and completions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace fathom {

struct OptionFacts {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional what its place is called
  std::string value;                 ///< what its value is called, "DIR"; empty: it takes none
  std::vector<std::string> choices;  ///< the values that it may have; empty: there is no such list
  std::string allowed;               ///< other bounds of its value, in CLI11's words
  std::string standard;              ///< what holds without it
  std::string help;
  bool is_positional = false, is_required = false, is_list = false;

  bool names_folder() const;
  bool is_number() const;
};

struct CommandFacts {
  std::string name;  ///< as it is typed: "fathom verify slab"
  std::string summary;
  std::string examples;
  std::vector<OptionFacts> options;
  std::vector<CommandFacts> commands;
};

/// `name` is what is typed before the command's own options.
CommandFacts facts_of(const CLI::App& command, const std::string& name);

/// The command and all below it, in the order of --help, each before its own commands.
std::vector<const CommandFacts*> all_commands(const CommandFacts& top);

/// "fathom-capture" of "fathom capture"
std::string page_name(const CommandFacts& command);

/// The man page, in the macros of man(7). A command's own commands are sections of its page; the program's have pages
/// of their own.
std::string man_page(const CommandFacts& command, bool is_program);

/// Scripts by which shells complete the program's commands, options and their values.
std::string bash_completion(const CommandFacts& program);
std::string zsh_completion(const CommandFacts& program);
std::string fish_completion(const CommandFacts& program);

}  // namespace fathom
