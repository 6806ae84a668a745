// `fathom manual`: man pages and completions, from the table of commands.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command_facts.h"
#include "app/commands.h"
#include "app/examples.h"
#include "core/files.h"

namespace fathom {
namespace {

void write_below(const std::filesystem::path& folder, const std::filesystem::path& name, const std::string& text) {
  make_directory((folder / name).parent_path());
  write_text(folder / name, text);
}

void write_manual(const std::filesystem::path& folder, const CommandFacts& program) {
  write_below(folder, "man/man1/fathom.1", man_page(program, true));
  for (const CommandFacts& command : program.commands)
    write_below(folder, "man/man1/" + page_name(command) + ".1", man_page(command, false));
  write_below(folder, "bash-completion/completions/fathom", bash_completion(program));
  write_below(folder, "zsh/vendor-completions/_fathom", zsh_completion(program));
  write_below(folder, "fish/vendor_completions.d/fathom.fish", fish_completion(program));
}

}  // namespace

std::function<void()> define_manual(CLI::App& app, const CommonOptions& common) {
  const auto scenes = std::make_shared<std::filesystem::path>();
  app.add_option("--scenes", *scenes, "What the examples call the scenes' folder, where it is not yet")
      ->type_name("DIR");
  return [&app, &common, scenes] {
    CommandFacts program = facts_of(*app.get_parent(), "fathom");
    if (!scenes->empty())
      for (CommandFacts& command : program.commands) command.examples = with_scenes(command.examples, *scenes);
    write_manual(common.output, program);
  };
}

}  // namespace fathom
