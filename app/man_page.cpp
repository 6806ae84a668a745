// Man pages of the program and its commands.
#include "app/command_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace fathom {
namespace {

/// Text as roff prints it, one line.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c == '\n' ? ' ' : c;
  return !result.empty() && (result[0] == '.' || result[0] == '\'') ? "\\&" + result : result;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fR", roff(text)); }
std::string italic(std::string_view text) { return fmt::format("\\fI{}\\fR", roff(text)); }

std::string option_text(const OptionFacts& option) {
  std::string head;
  for (const std::string& name : option.names)
    head += (head.empty() ? "" : ", ") + (option.is_positional ? italic(name) : bold(name));
  if (!option.is_positional && !option.value.empty()) head += " " + italic(option.value);
  if (option.is_list) head += " ...";
  std::string text = option.help;
  if (!option.choices.empty()) text += fmt::format(". One of {}", fmt::join(option.choices, ", "));
  if (!option.allowed.empty()) text += fmt::format(" ({})", option.allowed);
  if (!option.standard.empty()) text += fmt::format(". Without it {}", option.standard);
  return fmt::format(".TP\n{}\n{}{}\n", head, roff(text), option.is_required ? ". Required." : ".");
}

std::string options_text(const CommandFacts& command) {
  std::string text;
  for (const bool positional : {true, false})
    for (const OptionFacts& option : command.options)
      if (option.is_positional == positional) text += option_text(option);
  return text;
}

std::string synopsis(const CommandFacts& command) {
  std::string text = bold(command.name);
  if (!command.commands.empty()) text += " " + italic("command");
  for (const OptionFacts& option : command.options)
    if (option.is_required && !option.is_positional)
      text += fmt::format(" {} {}", bold(option.names.front()), italic(option.value));
  text += fmt::format(" [{}]", italic("options"));
  for (const OptionFacts& option : command.options)
    if (option.is_positional) {
      const std::string place = italic(option.names.front()) + (option.is_list ? " ..." : "");
      text += option.is_required ? " " + place : fmt::format(" [{}]", place);
    }
  return text + "\n";
}

std::string examples_text(const std::string& footer) {
  std::istringstream lines(footer);
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ")) text += roff(line.substr(2)) + "\n";
  return text.empty() ? "" : fmt::format(".SH EXAMPLES\n.EX\n{}.EE\n", text);
}

constexpr const char* kEnvironment =
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBFATHOM_DATA\\fR\nFolder of the cups, walls, media and sensors, instead of the one that came with the "
    "program.\n"
    ".TP\n\\fBFATHOM_DEVICES\\fR\nScene files and captured folders, parted by colons, that the driver of OpenNI2 shows "
    "as devices.\n";
constexpr const char* kExit =
    ".SH EXIT STATUS\n0 when all went well, 2 where the command line asks for what cannot be, 1 for every other "
    "error.\n";

}  // namespace

std::string page_name(const CommandFacts& command) {
  std::string name = command.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string man_page(const CommandFacts& command, bool is_program) {
  const std::string name = page_name(command);
  std::string title = roff(name);
  std::transform(title.begin(), title.end(), title.begin(), [](char c) { return 'a' <= c && c <= 'z' ? c - 32 : c; });
  std::string text = fmt::format(".TH \"{}\" \"1\" \"\" \"Fathom {}\" \"Fathom\"\n", title, FATHOM_VERSION);
  text += fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(command.summary));
  text += ".SH SYNOPSIS\n" + synopsis(command);
  text += ".SH OPTIONS\n" + options_text(command);
  if (!command.commands.empty()) text += ".SH COMMANDS\n";
  for (const CommandFacts& below : command.commands)
    if (is_program)
      text += fmt::format(".TP\n{}(1)\n{}.\n", bold(page_name(below)), roff(below.summary));
    else
      text += fmt::format(".SS {}\n{}.\n.PP\n{}{}", roff(below.name), roff(below.summary), synopsis(below),
                          options_text(below));
  text += examples_text(command.examples);
  text += kExit;
  text += is_program ? kEnvironment : ".SH SEE ALSO\n\\fBfathom\\fR(1)\n";
  return text;
}

}  // namespace fathom
