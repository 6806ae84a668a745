// blind_baselines: what simpler methods answer to a measurement, as reports that blind_score reads.
#include <filesystem>

#include "bench/baselines/diagnosis_baselines.h"
#include "blind/command_line.h"
#include "core/files.h"
#include "core/json.h"
#include "diagnosis/measurement/read_measurement.h"
#include "diagnosis/predict/physics.h"

namespace {

namespace fs = std::filesystem;
using namespace fathom;

/// Such a method names what it has chosen and is sure of it.
Json report_of(const Evidence& evidence, const std::vector<int>& chosen) {
  Json names = Json::array(), effects = Json::array();
  for (const int effect : chosen) {
    names.push_back(evidence.candidates[effect].effect);
    effects.push_back({{"name", names.back()}, {"parameters", Json::object()}});
  }
  return {{"verdict", chosen.empty() ? "none" : "named"},
          {"effects", effects},
          {"ambiguity_set", Json::array({{{"effects", names}, {"probability", 1.0}}})}};
}

void answer(const fs::path& folder, const fs::path& output) {
  const Evidence evidence =
      physics_of(read_measurement(folder), Json::array(), (folder / "rig.json").string()).evidence;
  const std::pair<const char*, std::vector<int> (*)(const Evidence&)> methods[] = {
      {"greedy_bic", greedy_bic},
      {"gls_bic", gls_bic},
      {"lasso_bic", lasso_bic},
      {"largest_correlation", largest_correlation}};
  for (const auto& [name, method] : methods) {
    const fs::path own = output / name / folder.lexically_normal().filename();
    make_directory(own);
    write_json(own / "report.json", report_of(evidence, method(evidence)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  fs::path folder, output;
  CLI::App app(
      "Answers to a measurement by greedy BIC (with independent noise and by generalised least squares), LASSO and the "
      "largest correlation");
  app.add_option("folder", folder, "Measurement directory")->required();
  app.add_option("-o,--output", output,
                 "Gets METHOD/NAME/report.json for each method, NAME being that of the directory")
      ->required();
  return blind::run_program(app, argc, argv, [&] { answer(folder, output); });
}
