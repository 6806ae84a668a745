#include "trials/trial_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace fathom {
namespace {

std::string number_text(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", *value) : ""; }

}  // namespace

Table cups_table(const std::vector<TrialResult>& trials) {
  Table table({"trial", "cup", "x_mm", "y_mm", "visible", "liquid", "fill_mm", "found", "miss", "liquid_found",
               "surface_mm", "kind_found", "fill_found_mm", "fill_sigma_mm", "p_liquid", "why"});
  for (const TrialResult& trial : trials) {
    for (const TrialCup& cup : trial.cups)
      table.add({trial.name, cup.shape, fmt::format("{:.1f}", cup.position_mm.x()),
                 fmt::format("{:.1f}", cup.position_mm.y()), fmt::format("{:.3f}", cup.visible), cup.liquid,
                 fmt::format("{:g}", cup.fill_mm), cup.found ? "yes" : "no",
                 cup.miss ? std::string(name_of(*cup.miss)) : "", cup.liquid_found, number_text(cup.surface_mm),
                 cup.kind_found, number_text(cup.fill_found_mm), number_text(cup.fill_sigma_mm),
                 number_text(cup.p_liquid), cup.why});
    for (const std::string& name : trial.false_cups)
      table.add({trial.name, name, "", "", "", "", "", "false", "", "", "", "", "", "", "", ""});
  }
  return table;
}

Table fillings_table(const std::vector<TrialResult>& trials) {
  struct FillingCounts {
    std::string liquid;
    double fill_mm;
    CupCounts counts{};
  };
  std::vector<FillingCounts> fillings;  // in the order of the trials
  for (const TrialResult& trial : trials)
    for (const TrialCup& cup : trial.cups) {
      auto known = std::find_if(fillings.begin(), fillings.end(), [&](const FillingCounts& filling) {
        return filling.liquid == cup.liquid && filling.fill_mm == cup.fill_mm;
      });
      if (known == fillings.end()) known = fillings.insert(known, {cup.liquid, cup.fill_mm});
      known->counts.add(cup);
    }
  Table table({"liquid", "fill_mm", "cups", "recognised", "liquid_detected"});
  for (const auto& [liquid, fill_mm, counts] : fillings)
    table.add({liquid, fmt::format("{:g}", fill_mm), fmt::format("{}", counts.cups), fmt::format("{}", counts.found),
               fmt::format("{}", counts.liquid)});
  return table;
}

}  // namespace fathom
