// blind_score: the answers to a pack beside its truth.
#include <fmt/format.h>

#include <filesystem>

#include "blind/command_line.h"
#include "blind/curves.h"
#include "blind/goals.h"
#include "blind/ledger.h"
#include "blind/pack.h"
#include "blind/settle.h"
#include "core/files.h"
#include "core/hash.h"

namespace {

namespace fs = std::filesystem;
using namespace fathom;
using namespace fathom::blind;

struct Options {
  fs::path pack, reports, truth, output, ledger;
  std::size_t first = 0;  // sets that are scored; 0: all
};

Json json_of(std::span<const Goal> goals) {
  Json list = Json::array();
  for (const Goal& goal : goals)
    list.push_back({{"metric", goal.metric},
                    {"value", goal.trials > 0 ? Json(goal.value) : Json()},
                    {"ci95", {goal.low, goal.high}},
                    {"hits", goal.hits},
                    {"trials", goal.trials},
                    {"bar", goal.bar},
                    {"verdict", goal.verdict()}});
  return list;
}

void print(std::span<const Goal> goals) {
  // A character of the metrics may take several bytes: fmt counts columns.
  for (const Goal& goal : goals)
    fmt::print(
        "{:46} {:>8} {:>17} {:>5} sets  {}\n", goal.metric, goal.trials > 0 ? fmt::format("{:.3f}", goal.value) : "–",
        goal.trials > 0 ? fmt::format("{:.3f} to {:.3f}", goal.low, goal.high) : "", goal.trials, goal.verdict());
}

/// The answers are hashed before the truth is looked at; the ledger says that it was.
std::string hash_of_reports(const fs::path& pack, const fs::path& reports, std::size_t sets) {
  std::string all;
  for (std::size_t i = 0; i < sets; ++i) {
    const fs::path answer = reports / set_folder(pack, static_cast<int>(i)).filename();
    all += fs::exists(answer / "report.json") ? sha256(read_text(answer / "report.json")) : "missing";
    if (const fs::path later = answer / "followed/report.json"; fs::exists(later)) all += sha256(read_text(later));
  }
  return sha256(all);
}

void score(const Options& options) {
  Pack pack = open_pack(options.pack, options.truth);
  if (options.first > 0 && options.first < pack.sets.size()) pack.sets.resize(options.first);
  std::vector<Judged> judged;
  for (const SetTruth& truth : pack.sets) {
    const fs::path answer = options.reports / set_folder(options.pack, truth.number).filename();
    judged.push_back({truth, read_answer(answer)});
    if (fs::exists(answer / "followed")) judged.back().followed = read_answer(answer / "followed");
  }
  if (!options.ledger.empty()) {
    if (const auto earlier = opened_at(options.ledger, pack.truth_sha256); earlier && pack.kind == "sealed")
      fmt::print("this pack was opened on {}: it is development data now\n", *earlier);
    add_to_ledger(options.ledger, {.event = "opened",
                                   .pack = pack.name,
                                   .kind = pack.kind,
                                   .seed = pack.seed,
                                   .sets = static_cast<int>(pack.sets.size()),
                                   .truth_sha256 = pack.truth_sha256,
                                   .results_sha256 = hash_of_reports(options.pack, options.reports, pack.sets.size())});
  }
  const std::vector<Goal> goals = goals_of(judged);
  make_directory(options.output);
  write_table(options.output / "goals.csv", table_of(goals));
  write_table(options.output / "power.csv", power_table(judged));
  write_table(options.output / "confusion.csv", confusion_table(judged));
  write_table(options.output / "reliability.csv", reliability_table(judged));
  write_table(options.output / "risk_coverage.csv", risk_coverage_table(judged));
  write_table(options.output / "worst.csv", worst_table(judged));
  write_table(options.output / "follow_ups.csv", follow_up_table(judged));
  write_table(options.output / "sets.csv", sets_table(judged));
  write_json(options.output / "score.json", {{"pack", pack.name},
                                             {"kind", pack.kind},
                                             {"sets", pack.sets.size()},
                                             {"truth_sha256", pack.truth_sha256},
                                             {"goals", json_of(goals)}});
  print(goals);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Scores the answers to a pack against its truth");
  app.add_option("pack", options.pack, "Folder of the pack")->required();
  app.add_option("reports", options.reports, "Folder with NNNN/report.json of each set")->required();
  app.add_option("--truth", options.truth, "The truth's file")->required();
  app.add_option("-o,--output", options.output, "Where to write goals.csv, power.csv, … and score.json")->required();
  app.add_option("--first", options.first,
                 "Scores only so many sets, of a pack that is still being diagnosed: their order is drawn")
      ->check(CLI::PositiveNumber);
  app.add_option("--ledger", options.ledger, "Append-only list of packs, to which the opening is added");
  return run_program(app, argc, argv, [&] { score(options); });
}
