// Numbers of the command line, of every command: what is none, or none that fits, is bad usage.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/run_fathom.h"

namespace fathom {
namespace {

struct NumberOption {
  std::string command, name, type;
};

/// Options that take numbers, as the command's help lists them: "  --seed UINT=1 …".
std::vector<NumberOption> number_options(const std::string& command) {
  const std::regex line(R"(^\s+(--[a-z-]+) (UINT|INT|FLOAT\|inf|FLOAT,…|FLOAT|MM|DEG)(?=[ =:]|$).*)");
  std::vector<NumberOption> found;
  std::istringstream help(run_fathom(command + " --help").out);
  std::smatch parts;
  for (std::string text; std::getline(help, text);)
    if (std::regex_search(text, parts, line)) found.push_back({command, parts[1], parts[2]});
  return found;
}

std::vector<NumberOption> all_number_options() {
  std::vector<std::string> commands;
  std::istringstream help(run_fathom("--help").out);
  bool in_list = false;
  for (std::string text; std::getline(help, text);) {
    if (in_list && text.starts_with("  ") && text[2] != ' ') commands.push_back(text.substr(2, text.find(' ', 2) - 2));
    in_list = in_list || text.starts_with("Subcommands");
  }
  commands.insert(commands.end(), {"verify slab", "verify fresnel"});
  std::vector<NumberOption> found;
  for (const std::string& command : commands)
    for (const NumberOption& option : number_options(command)) found.push_back(option);
  return found;
}

/// What no option may take.
const std::vector<std::string> kWrongForAll{"", "1e400"};

/// Of an option of that type, everything that is tried.
std::vector<std::string> all_wrong(const std::string& type) {
  std::vector<std::string> wrong{"",     "1e400", " ",    "1 ",  " 1",
                                 "0x10", "ten",   "-",    "+",   "+-1",
                                 "--1",  "nan",   "-inf", "1_0", "99999999999999999999999e400"};
  const auto add = [&](std::initializer_list<const char*> texts) {
    wrong.insert(wrong.end(), texts.begin(), texts.end());
  };
  if (type.ends_with("INT")) add({"1.5", "1e2", "18446744073709551616", "-18446744073709551616", "1,2"});
  if (type == "UINT") add({"-1", "-0x1"});
  if (type != "FLOAT|inf") add({"inf"});
  if (type == "FLOAT,…") add({"10,,20", "10,", ",", "[10,20]", "10,1e400"});
  return wrong;
}

TEST(NumbersOfTheCommandLine, AreNumbersAndNothingElse) {
  const std::vector<NumberOption> options = all_number_options();
  std::set<std::string> names;
  for (const NumberOption& option : options) names.insert(option.name);
  for (const char* known : {"--seed", "--threads", "--frames", "--spp", "--trials", "--fill-mm", "--pitch-deg",
                            "--liquid-threshold-mm", "--max-input-mb", "--thickness-mm", "--photons", "--from"})
    EXPECT_TRUE(names.contains(known)) << known;
  std::set<std::string> types;
  for (const NumberOption& option : options)
    for (const std::string& text : types.insert(option.type).second ? all_wrong(option.type) : kWrongForAll) {
      // "--seed=" has no value at all, "--seed ''" an empty one.
      const ProgramRun run =
          run_fathom(option.command + " '" + option.name + (text.empty() ? "' '" : "=") + text + "'");
      EXPECT_EQ(run.exit_code, 2) << option.command << " " << option.name << "=" << text;
      EXPECT_TRUE(run.err.starts_with("error: " + option.name + ": must be a ")) << run.err;
      EXPECT_EQ(run.out, "");
    }
  EXPECT_EQ(types.size(), 7u);  // so many kinds of numbers; one option of each is tried with everything
}

TEST(NumbersOfTheCommandLine, AreDecimalAndUseTheirWholeRange) {
  const std::string slab =
      "verify slab --index 1 --absorption-per-mm 1 --scattering-per-mm 1 --anisotropy 0 --thickness-mm 1 --json ";
  const auto out = [&](const std::string& options) {
    const ProgramRun run = run_fathom(slab + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  const std::string ten = out("--photons 10 --seed 10");
  EXPECT_EQ(out("--photons 010 --seed 0010"), ten);  // not the 8 of C
  EXPECT_EQ(out("--photons +10 --seed +10"), ten);
  EXPECT_NE(out("--photons 10 --seed 18446744073709551615"), ten);
  EXPECT_EQ(run_fathom("verify slab --seed 18446744073709551616").err,
            "error: --seed: must be a whole number from 0 to 18446744073709551615, got '18446744073709551616'\n"
            "Run with --help for more information.\n");
}

TEST(NumbersOfTheCommandLine, ComeInListsPartedByCommasOrBlanks) {
  const std::string commas = run_fathom("theory --fill-mm 10,+20,3e1 --distance-mm 400").out;
  EXPECT_EQ(std::count(commas.begin(), commas.end(), '\n'), 4);
  EXPECT_EQ(run_fathom("theory --fill-mm 10 20 30 --distance-mm 400").out, commas);
  EXPECT_EQ(run_fathom("theory --fill-mm 10,20 --fill-mm 30 --distance-mm 400").out, commas);
}

}  // namespace
}  // namespace fathom
