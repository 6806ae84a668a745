// Completions for bash, zsh and fish.
#include "app/command_facts.h"

#include <fmt/format.h>

#include <algorithm>

namespace fathom {
namespace {

/// In single quotes, as all three shells read them.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// "slab" of "fathom verify slab"
std::string last_word(const CommandFacts& command) { return command.name.substr(command.name.rfind(' ') + 1); }

std::vector<std::string> words_after_program(const CommandFacts& command) {
  std::vector<std::string> words;
  for (std::size_t at = command.name.find(' '); at != std::string::npos;) {
    const std::size_t end = command.name.find(' ', at + 1);
    words.push_back(command.name.substr(at + 1, end == std::string::npos ? end : end - at - 1));
    at = end;
  }
  return words;
}

bool takes_value(const OptionFacts& option) { return !option.is_positional && !option.value.empty(); }

// bash -------------------------------------------------------------------------------------------------------------

/// What is done where the option's value is to be typed.
std::string bash_value(const OptionFacts& option) {
  if (!option.choices.empty())
    return fmt::format("COMPREPLY=($(compgen -W {} -- \"$current\"))",
                       quoted(fmt::format("{}", fmt::join(option.choices, " "))));
  if (option.names_folder()) return "compopt -o filenames; COMPREPLY=($(compgen -d -- \"$current\"))";
  return option.is_number() ? "compopt +o default" : ":";  // with nothing found, bash offers files
}

std::string bash_case(const CommandFacts& command) {
  std::vector<std::string> options, words;
  std::string values;
  for (const OptionFacts& option : command.options) {
    if (option.is_positional)
      words.insert(words.end(), option.choices.begin(), option.choices.end());
    else
      options.insert(options.end(), option.names.begin(), option.names.end());
    if (takes_value(option))
      values += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, "|"), bash_value(option));
  }
  for (const CommandFacts& below : command.commands) words.push_back(last_word(below));
  std::string text = fmt::format("    {})\n", quoted(command.name));
  if (!values.empty()) text += fmt::format("      case $previous in\n{}      esac\n", values);
  return text + fmt::format("      options={} words={} ;;\n", quoted(fmt::format("{}", fmt::join(options, " "))),
                            quoted(fmt::format("{}", fmt::join(words, " "))));
}

// zsh --------------------------------------------------------------------------------------------------------------

/// Text within an argument of _arguments, where colons and brackets part what it says.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == ':' || c == '[' || c == ']' ? std::string("\\") + c : std::string(1, c);
  return result;
}

std::string zsh_action(const OptionFacts& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  if (option.names_folder()) return "_files -/";
  return option.is_number() ? " " : "_files";
}

std::string zsh_option(const OptionFacts& option) {
  const std::string value = zsh_text(option.value.empty() ? option.names.front() : option.value);
  if (option.is_positional)
    return " " + quoted(fmt::format("{}:{}:{}", option.is_list ? "*" : "", value, zsh_action(option)));
  std::string text;
  for (const std::string& name : option.names)
    text += " " + quoted(fmt::format("{}[{}]{}", name, zsh_text(option.help),
                                     option.value.empty() ? "" : fmt::format(":{}:{}", value, zsh_action(option))));
  return text;
}

std::string zsh_function(const CommandFacts& command) {
  std::string name = "_" + command.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  std::string arguments;
  for (const OptionFacts& option : command.options) arguments += zsh_option(option);
  if (command.commands.empty()) return fmt::format("{}() {{\n  _arguments{}\n}}\n", name, arguments);
  std::string commands, cases;
  for (const CommandFacts& below : command.commands) {
    commands += " " + quoted(zsh_text(last_word(below)) + ":" + below.summary);
    cases += fmt::format("      {0}) {1}_{0} ;;\n", last_word(below), name);
  }
  return fmt::format(
      "{}() {{\n  local context state state_descr line\n  local -a commands=({})\n  typeset -A opt_args\n"
      "  _arguments -C{} '1: :->command' '*:: :->rest'\n  case $state in\n"
      "    command) _describe command commands ;;\n    rest)\n      case $words[1] in\n{}      esac ;;\n  esac\n}}\n",
      name, commands, arguments, cases);
}

// fish -------------------------------------------------------------------------------------------------------------

/// When what is typed so far has come to that command.
std::string fish_condition(const CommandFacts& command) {
  std::string text;
  for (const std::string& word : words_after_program(command))
    text += fmt::format("{}__fish_seen_subcommand_from {}", text.empty() ? "" : "; and ", word);
  if (command.commands.empty()) return text;
  text += fmt::format("{}not __fish_seen_subcommand_from", text.empty() ? "" : "; and ");
  for (const CommandFacts& below : command.commands) text += " " + last_word(below);
  return text;
}

std::string fish_value(const OptionFacts& option) {
  if (!option.choices.empty())
    return fmt::format(" -x -a {}", quoted(fmt::format("{}", fmt::join(option.choices, " "))));
  if (option.names_folder()) return " -x -a '(__fish_complete_directories)'";
  return option.is_number() ? " -x" : " -r -F";
}

std::string fish_lines(const CommandFacts& command) {
  const std::string start = fmt::format("complete -c fathom -n {}", quoted(fish_condition(command)));
  std::string text;
  for (const OptionFacts& option : command.options) {
    if (option.is_positional) {
      text += start + (option.choices.empty() ? " -F" : " -f" + fish_value(option).substr(3)) + "\n";
      continue;
    }
    text += start;
    for (const std::string& name : option.names)
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    text += (takes_value(option) ? fish_value(option) : "") + " -d " + quoted(option.help) + "\n";
  }
  for (const CommandFacts& below : command.commands)
    text += fmt::format("{} -f -a {} -d {}\n", start, last_word(below), quoted(below.summary));
  return text;
}

}  // namespace

std::string bash_completion(const CommandFacts& program) {
  std::string text =
      "# bash completion for fathom, made by `fathom manual`\n"
      "_fathom() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=fathom options words "
      "i\n"
      "  # bash parts --mode=geometric at the sign\n"
      "  if [[ $current == '=' ]]; then current=''; elif [[ $previous == '=' ]]; then previous=${COMP_WORDS[COMP_CWORD "
      "- 2]}; "
      "fi\n"
      "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
      "    case \"$command ${COMP_WORDS[i]}\" in\n      ";
  std::vector<std::string> names;
  for (const CommandFacts* command : all_commands(program))
    if (command != &program) names.push_back(quoted(command->name));
  text += fmt::format("{}) command+=\" ${{COMP_WORDS[i]}}\" ;;\n    esac\n  done\n  case $command in\n",
                      fmt::join(names, "|"));
  for (const CommandFacts* command : all_commands(program)) text += bash_case(*command);
  return text +
         "  esac\n  [[ $current == -* ]] && words=$options\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n}\n"
         "complete -o default -F _fathom fathom\n";
}

std::string zsh_completion(const CommandFacts& program) {
  std::string text = "#compdef fathom\n# zsh completion for fathom, made by `fathom manual`\n";
  for (const CommandFacts* command : all_commands(program)) text += zsh_function(*command);
  return text + "if [ \"$funcstack[1]\" = _fathom ]; then _fathom \"$@\"; else compdef _fathom fathom; fi\n";
}

std::string fish_completion(const CommandFacts& program) {
  std::string text = "# fish completion for fathom, made by `fathom manual`\ncomplete -c fathom -f\n";
  for (const CommandFacts* command : all_commands(program)) text += fish_lines(*command);
  return text;
}

}  // namespace fathom
