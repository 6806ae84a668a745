// Prints what the diagnosis says of measured desks when its model lacks what is known to be there, as a table.
#include <fmt/format.h>

#include <cstdio>

#include "bench/measured_desks.h"
#include "bench/real_desks.h"

int main() {
  using namespace fathom;
  if (measured_desks().empty()) {
    fmt::print("skipped: no measured clouds (FATHOM_REAL_DATA)\n");
    return 0;
  }
  fmt::print("| left out of the model | verdict | named | open | before | after |\n|---|---|---|---|---|---|\n");
  std::vector<std::string> left_out{""};
  left_out.insert(left_out.end(), known_of_desks().begin(), known_of_desks().end());
  for (const std::string& without : left_out) {
    const DeskDiagnosis found = *diagnose_desks(without);
    std::string named, open;
    for (const NamedEffect& effect : found.diagnosis.effects) {
      named += (named.empty() ? "" : ", ") + effect.name;
      for (const NamedParameter& p : effect.parameters) named += fmt::format(" {} = {:.2g}", p.name, p.value);
    }
    for (const Explanation& explanation : found.diagnosis.ambiguity_set)
      open += fmt::format("{}{} {:.2f}", open.empty() ? "" : "; ", fmt::join(explanation.effects, "+"),
                          explanation.probability);
    fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} |\n", without.empty() ? "nothing" : without,
               name_of(found.diagnosis.verdict), named, open, found.before, found.after);
    std::fflush(stdout);
  }
}
