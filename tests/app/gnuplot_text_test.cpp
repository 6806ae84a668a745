// Text of any characters in gnuplot's scripts and in pages: it is shown, and never obeyed.
#include "report/gnuplot_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/files.h"
#include "core/rng.h"
#include "core/visible_text.h"
#include "report/html.h"
#include "report/whole_picture.h"
#include "tests/app/svg_text.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

/// Pieces that gnuplot, its enhanced text, its formats and shells have a meaning for.
const std::vector<std::string> kPieces{"'",
                                       "\"",
                                       "\\",
                                       "`touch pwned`",
                                       "$(touch pwned)",
                                       "system('touch pwned')",
                                       "@",
                                       "@macro",
                                       "_",
                                       "^",
                                       "{",
                                       "}",
                                       "{/Bold b}",
                                       "&",
                                       "~a",
                                       "%",
                                       "%d",
                                       "%s",
                                       "#",
                                       ";",
                                       "\\n",
                                       "\\0",
                                       "7",
                                       "é",
                                       "水",
                                       "<b>",
                                       ">",
                                       "$1",
                                       "[",
                                       "]",
                                       "|",
                                       "!touch pwned",
                                       "''",
                                       "a",
                                       "\u00a0",
                                       "\x1b[2J",
                                       "\n",
                                       "\xff"};

std::vector<std::string> labels() {
  std::vector<std::string> result{"x'; system('touch pwned'); set label 'y",
                                  "farmer's milk",
                                  "a`touch pwned`b",
                                  "@x $y \"z\" \\n {/Bold b}_1^2",
                                  "\\",
                                  "'"};
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    std::string label = "a";  // blanks at the ends say nothing
    for (std::size_t left = 1 + rng.bits() % 8; left > 0; --left) label += kPieces[rng.bits() % kPieces.size()];
    result.push_back(label);
  }
  return result;
}

struct Script : testing::Test {
  TemporaryFolder folder;

  std::string svg(const std::string& commands) {
    write_text(folder / "script.gp",
               "macro = 'EXPANDED'; set encoding utf8; set xrange [-1:3000]\nset terminal svg\n"
               "set output 'out.svg'\n" +
                   commands + "\nplot 0 title ''\nunset output\n");
    const std::string run = fmt::format("cd {} && gnuplot -d script.gp 2> said", (folder / "").string());
    EXPECT_EQ(std::system(run.c_str()), 0) << read_text(folder / "said");
    EXPECT_FALSE(std::filesystem::exists(folder / "pwned"));
    const std::string text = read_text(folder / "out.svg");
    EXPECT_TRUE(is_whole_svg(text));
    return text;
  }
};

TEST_F(Script, LabelsOfAnyCharactersAreShownAsWrittenAndNeverObeyed) {
  std::string commands;
  const std::vector<std::string> all = labels();
  for (std::size_t i = 0; i < all.size(); ++i)
    commands += fmt::format("set label {} at {},0.5 noenhanced\n", gnuplot_text(all[i]), i);
  const std::string shown = svg(commands);
  for (const std::string& label : all) EXPECT_TRUE(shows(shown, label)) << label;
}

TEST_F(Script, SoAreTicsWhichAreFormatsToGnuplot) {
  std::vector<std::string> all = labels();
  std::erase_if(all, [](const std::string& label) { return on_one_line(label).size() > 40; });
  const std::string shown = svg(gnuplot_xtics(all));
  for (const std::string& label : all) EXPECT_TRUE(shows(shown, label)) << label;
}

TEST(WholePicture, IsOneOfWhichNothingIsMissing) {
  const std::string svg =
      "<?xml version=\"1.0\"?>\n<!-- <g> -->\n<svg width=\"9\">\n<g a='/'><path d='M 1'/></g>\n<text>a"
      " &lt;</text></svg>\n\n";
  EXPECT_TRUE(is_whole_svg(svg));
  for (std::size_t size = 0; size + 3 < svg.size(); ++size) EXPECT_FALSE(is_whole_svg(svg.substr(0, size))) << size;
  EXPECT_FALSE(is_whole_svg("<svg><g><g></g></svg>"));         // a hole in the middle
  EXPECT_FALSE(is_whole_svg("<svg><path d='M 1 </g></svg>"));  // likewise
  EXPECT_FALSE(is_whole_svg("<svg></svg><svg></svg>"));
  EXPECT_FALSE(is_whole_svg("gnuplot says no"));
}

TEST(Html, TextEndsNeitherElementsNorAttributes) {
  EXPECT_EQ(html_escaped("\"><script>x</script>&amp;\x1b"), "&quot;&gt;&lt;script&gt;x&lt;/script&gt;&amp;amp;\\u001b");
}

}  // namespace
}  // namespace fathom
