// `fathom reproduce`: the paper's figures, simulated beside printed.
#include "paper/figures.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <variant>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/json.h"
#include "report/gnuplot.h"

namespace fathom {
namespace {

using FromSettings = Figure (*)(const ReproduceSettings&);
using FromHeights = Figure (*)(const ReproduceSettings&, const PaperHeights&);

struct FigureEntry {
  const char* name;
  std::variant<FromSettings, FromHeights> reproduce;
  bool of_paper = true;  ///< whether "all" includes it
};

constexpr std::array<FigureEntry, 12> kFigures{{{"fig2", reproduce_fig2},
                                                {"fig3", reproduce_fig3},
                                                {"fig4", reproduce_fig4},
                                                {"fig5", reproduce_fig5},
                                                {"fig10", reproduce_fig10},
                                                {"fig12", reproduce_fig12},
                                                {"fig13", reproduce_fig13},
                                                {"fig14", reproduce_fig14},
                                                {"recognition", reproduce_recognition},
                                                {"table1", reproduce_table1},
                                                {"liquids", reproduce_liquids, false},
                                                {"scattering", reproduce_scattering, false}}};

struct ReproduceOptions {
  std::vector<std::string> figures{"all"};
  std::optional<int> trials;
};

/// Measures the heights once, when the first figure asks for them.
class Reproduction {
 public:
  explicit Reproduction(ReproduceSettings settings) : settings_(std::move(settings)) {}

  Figure operator()(FromSettings reproduce) { return reproduce(settings_); }
  Figure operator()(FromHeights reproduce) {
    if (!heights_) heights_ = measure_paper_heights(settings_.shots(), settings_.seed, settings_.quiet);
    return reproduce(settings_, *heights_);
  }

 private:
  ReproduceSettings settings_;
  std::optional<PaperHeights> heights_;
};

std::string text_of(const Figure& figure) {
  std::string text = fmt::format("{}\n  {}\n", figure.title, figure.sentence);
  for (const Fact& fact : figure.facts)
    text += fmt::format("  - {}\n      paper: {}\n      here:  {}\n", fact.what, fact.printed, fact.here);
  return text;
}

Json json_of(const Figure& figure) {
  Json facts = Json::array();
  for (const Fact& fact : figure.facts)
    facts.push_back({{"what", fact.what}, {"paper", fact.printed}, {"here", fact.here}});
  return {{"figure", figure.name}, {"title", figure.title}, {"facts", facts}};
}

void run_reproduce(const ReproduceOptions& options, const CommonOptions& common) {
  require_gnuplot();
  const FolderOwner owner(common.output);
  remove_if_ours(common.output / "report.html", kReportTitle);  // it comes last, and is of the figures beside it
  Reproduction reproduction(
      {.folder = common.output, .trials = options.trials, .seed = common.seed, .quiet = common.quiet});
  const auto asked = [&](const std::string& name) {
    return std::find(options.figures.begin(), options.figures.end(), name) != options.figures.end();
  };
  std::vector<Figure> figures;
  Json json = Json::array();
  for (const FigureEntry& entry : kFigures) {
    if (!(asked("all") && entry.of_paper) && !asked(entry.name)) continue;
    figures.push_back(std::visit(reproduction, entry.reproduce));
    json.push_back(json_of(figures.back()));
    if (!common.json) print_text(text_of(figures.back()));
  }
  write_report(common.output, figures);
  if (common.json) print_text(json_text(json));
}

}  // namespace

std::function<void()> define_reproduce(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<ReproduceOptions>();
  std::vector<std::string> names{"all"};
  for (const FigureEntry& entry : kFigures) names.emplace_back(entry.name);
  app.add_option("figures", options->figures,
                 "Which figures; all: of the paper. recognition and table1: its experiments on random desks, some "
                 "minutes each; liquids: fig5 of all its liquids in full light, some minutes; "
                 "scattering: what is uncertain of its milk tea, ten minutes")
      ->check(one_of("figure", names))
      ->capture_default_str();
  app.add_option(
         "--trials", options->trials,
         "Shots of each condition: of figures 3 (the paper's are 10), desks of recognition 20 and of table1 10, "
         "places of the cup in scattering 3")
      ->check(CLI::Range(1, 1000));
  return [options, &common] { run_reproduce(*options, common); };
}

}  // namespace fathom
