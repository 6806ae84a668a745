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
<p>Infrared image and measured depth; below them the apparent depth (that of a device without errors) and the difference. Green: outlines of cups that were found, red: of those that
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

std::string failure_figures(const std::vector<TrialResult>& trials, const std::string& beside) {
  std::string figures;
  for (const Kind& kind : kKinds) {
    bool is_first = true;
    for (const TrialResult& trial : trials) {
      if (failure_of(trial) != kind.name) continue;
      if (is_first) figures += fmt::format("<h2 id=\"{0}\">{0}</h2>\n<p>{1}.</p>\n", kind.name, kind.words);
      is_first = false;
      figures += fmt::format("<figure><img src=\"{0}{1}.png\" alt=\"{1}\"><figcaption>{1}: {2}</figcaption></figure>\n",
                             beside, fmt::format("{}_{}", trial.name, kind.name), caption(trial));
    }
  }
  return figures;
}

std::string failure_counts(const std::vector<TrialResult>& trials) {
  std::vector<std::vector<std::string>> counts;
  for (const Kind& kind : kKinds) {
    const auto failed = [&](const TrialResult& trial) { return failure_of(trial) == kind.name; };
    counts.push_back({fmt::format("{}", std::count_if(trials.begin(), trials.end(), failed)), std::string(kind.name),
                      std::string(kind.words)});
  }
  return html_table({"trials", "kind", "what"}, counts);
}

void write_failure_gallery(const fs::path& folder, const std::vector<TrialResult>& trials) {
  write_text(folder / "failures" / "index.html",
             html_page("Fathom: what failed", kHead + failure_counts(trials) + failure_figures(trials, "")));
}

}  // namespace fathom
