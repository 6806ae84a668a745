// usage: diagnose_folder DIR
// What a measurement directory (rig.json, frames.csv, clouds) says of its model, by the diagnosis' library alone.
#include <cstdio>
#include <exception>

#include <fathom/diagnosis/decision/decide.h>
#include <fathom/diagnosis/measurement/read_measurement.h>
#include <fathom/diagnosis/predict/physics.h>
#include <fathom/report/diagnosis_words.h>

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: diagnose_folder DIR\n");
    return 2;
  }
  const fathom::Measurement measurement = fathom::read_measurement(argv[1]);
  const fathom::Physics physics = fathom::physics_of(measurement);
  const fathom::Diagnosis diagnosis = fathom::decide(physics.evidence, physics.predict);
  std::printf("%s\n", fathom::answer(diagnosis).c_str());
  for (const fathom::Explanation& explanation : diagnosis.ambiguity_set)
    std::printf("%5.1f %%  %s\n", 100.0 * explanation.probability, fathom::effects_words(explanation.effects).c_str());
} catch (const std::exception& problem) {
  std::fprintf(stderr, "error: %s\n", problem.what());
  return 1;
}
