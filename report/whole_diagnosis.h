// A diagnosis from a laboratory's folders to what is said of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "diagnosis/measurement/read_measurement.h"
#include "diagnosis/predict/designs.h"
#include "diagnosis/predict/physics.h"
#include "diagnosis/ray_traced/traced_diagnosis.h"

namespace fathom {

struct DiagnosisSettings {
  std::vector<std::filesystem::path> folders;  ///< further ones are later sessions of one rig
  std::filesystem::path model;                 ///< model.json of an earlier diagnosis; empty: none
  std::vector<std::string> without;            ///< ids of effects that are not considered
  bool photometric = false;                    ///< after few rays whole simulated images of what is left
  std::uint64_t seed = 1;
};

/// What a diagnosis starts from.
struct DiagnosisInput {
  DiagnosisSettings settings;
  Json model_effects;
  Measurement measurement;  ///< with its mistakes put right
  Physics physics;
  std::vector<std::string> not_looked_for;  ///< of `without` those that were candidates

  std::string rig_file() const { return (settings.folders.front() / "rig.json").string(); }
};

struct WholeDiagnosis {
  std::vector<Observation> observations;
  Diagnosis diagnosis;                       ///< of these
  std::optional<RayTracedDiagnosis> traced;  ///< where it was asked for and few rays suffice for an answer
  Diagnosis by_few_rays;
  std::vector<std::string> notes;        ///< what limits the measurement or the model of it, one sentence each
  std::vector<std::string> not_covered;  ///< effects that cannot be seen or were left out, one sentence each
  std::vector<MeasurementPlan> plans;    ///< that could be measured next

  std::vector<std::string> all_notes() const;  ///< and what is not covered
};

/// Reads the folders and predicts what the model expects. Throws Error naming file and place. Tells of its progress
/// unless `quiet`.
DiagnosisInput read_diagnosis_input(const DiagnosisSettings& settings, bool quiet);

/// Decides.
WholeDiagnosis diagnose(const DiagnosisInput& input, bool quiet);

/// report.json without its provenance.
Json diagnosis_report_json(const WholeDiagnosis& whole);

}  // namespace fathom
