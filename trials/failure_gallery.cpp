#include "trials/failure_gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/files.h"
#include "report/html.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct Kind {
  std::string_view name, words;
};

constexpr std::array<Kind, 5> kKinds{{{"merged", "The cup's segment holds other things too: the paper's Fig. 17"},
                                      {"occluded", "Other things hide much of the cup: the paper's Fig. 18"},
                                      {"refused", "Neither: the method looked at it and said no"},
                                      {"liquid", "A liquid is seen in an empty cup, or none in a filled one"},
                                      {"false_cup", "Something else is taken for a cup"}}};

constexpr const char* kHead = R"(<h1>What failed</h1>
<p>Infrared image and measured depth; below them the true depth and the difference. Green: outlines of cups that were found, red: of those that
were not; blue: circles of what was taken for a cup. <code>fathom capture NUMBER_KIND.json</code> shoots the scene again.</p>
)";

bool is_wrong(const TrialCup& cup) { return cup.liquid_found == (cup.liquid == "empty" ? "yes" : "no"); }

std::string caption(const TrialResult& trial) {
  std::vector<std::string> lines;
  for (const TrialCup& cup : trial.cups) {
    const std::string what =
        fmt::format("{} ({} {:g} mm), {:.0f} % in sight", cup.shape, cup.liquid, cup.fill_mm, 100.0 * cup.visible);
    if (cup.miss) lines.push_back(fmt::format("{}: missed, {}: {}", what, name_of(*cup.miss), cup.why));
    if (is_wrong(cup))
      lines.push_back(fmt::format("{}: liquid {}, P {:.3f}, height inside {:.1f} mm", what, cup.liquid_found,
                                  cup.p_liquid.value_or(0.0), cup.surface_mm.value_or(0.0)));
  }
  for (const std::string& name : trial.false_cups) lines.push_back(name + ": taken for a cup");
  for (std::string& line : lines) line = html_escaped(line);
  return fmt::format("{}", fmt::join(lines, "<br>"));
}

}  // namespace

std::string failure_of(const TrialResult& trial) {
  for (const TrialCup& cup : trial.cups) {
    if (cup.miss) return std::string(name_of(*cup.miss));
    if (is_wrong(cup)) return "liquid";
  }
  return trial.false_cups.empty() ? "" : "false_cup";
}

void write_failure_gallery(const fs::path& folder, const std::vector<TrialResult>& trials) {
  std::vector<std::vector<std::string>> counts;
  std::string figures;
  for (const Kind& kind : kKinds) {
    int count = 0;
    for (const TrialResult& trial : trials) {
      if (failure_of(trial) != kind.name) continue;
      if (++count == 1) figures += fmt::format("<h2 id=\"{}\">{}</h2>\n", kind.name, kind.name);
      figures += fmt::format("<figure><img src=\"{0}.png\" alt=\"{0}\"><figcaption>{0}: {1}</figcaption></figure>\n",
                             fmt::format("{}_{}", trial.name, kind.name), caption(trial));
    }
    counts.push_back({fmt::format("{}", count), std::string(kind.name), std::string(kind.words)});
  }
  write_text(folder / "failures" / "index.html",
             html_page("Fathom: what failed", kHead + html_table({"trials", "kind", "what"}, counts) + figures));
}

}  // namespace fathom
