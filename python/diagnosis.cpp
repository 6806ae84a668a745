// Where model and measurement disagree.
#include <filesystem>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/objects.h"
#include "python/watched.h"
#include "report/diagnosis_words.h"
#include "report/whole_diagnosis.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

/// One number of every observation.
template <class Value>
auto column_of(const std::vector<Observation>& observations, Value value) {
  std::vector<decltype(value(observations.front()))> column;
  column.reserve(observations.size());
  for (const Observation& observation : observations) column.push_back(value(observation));
  return column;
}

/// The columns of residuals.csv.
py::dict residuals_of(const WholeDiagnosis& whole) {
  const std::vector<Observation>& all = whole.observations;
  Residuals residuals = whole.diagnosis.residuals;
  py::dict columns;
  columns["observable"] = column_of(all, [](const Observation& o) { return o.observable; });
  columns["region"] = column_of(all, [](const Observation& o) { return o.factors.region; });
  columns["session"] = array_of(column_of(all, [](const Observation& o) { return o.factors.session; }));
  columns["pour"] = array_of(column_of(all, [](const Observation& o) { return o.factors.pour; }));
  columns["placement"] = array_of(column_of(all, [](const Observation& o) { return o.factors.placement; }));
  columns["liquid"] = column_of(all, [](const Observation& o) { return o.factors.liquid; });
  columns["fill_mm"] = array_of(column_of(all, [](const Observation& o) { return o.factors.fill_mm; }));
  columns["distance_mm"] = array_of(column_of(all, [](const Observation& o) { return o.factors.distance_mm; }));
  columns["lateral_mm"] = array_of(column_of(all, [](const Observation& o) { return o.factors.lateral_mm; }));
  columns["measured"] = array_of(column_of(all, [](const Observation& o) { return o.value; }));
  columns["before"] = array_of(std::move(residuals.before));
  columns["after"] = array_of(std::move(residuals.after));
  columns["sigma"] = array_of(std::move(residuals.error));
  columns["pixels"] = array_of(column_of(all, [](const Observation& o) { return o.pixels; }));
  return columns;
}

py::list posterior_of(const Diagnosis& diagnosis) {
  py::list rows;
  for (const Explanation& explanation : diagnosis.ambiguity_set) {
    py::dict row;
    row["effects"] = py::tuple(py::cast(explanation.effects));
    row["words"] = effects_words(explanation.effects);
    row["probability"] = explanation.probability;
    rows.append(row);
  }
  return rows;
}

py::dict diagnose_folders(const std::vector<std::filesystem::path>& folders,
                          const std::optional<std::filesystem::path>& model, const std::vector<std::string>& without,
                          const std::string& fidelity, std::uint64_t seed, const py::object& progress) {
  const std::vector<std::string> effects = effect_ids();
  for (const std::string& effect : without) choice_of("effect", effect, effects);
  const bool photometric = choice_of("fidelity", fidelity, {"geometric", "photometric"}) == 1;
  const WholeDiagnosis whole = watched(progress, [&] {
    return diagnose(read_diagnosis_input({.folders = folders,
                                          .model = model.value_or(""),
                                          .without = without,
                                          .photometric = photometric,
                                          .seed = seed},
                                         true),
                    true);
  });
  py::dict dict;
  dict["posterior"] = posterior_of(whole.diagnosis);
  dict["residuals"] = residuals_of(whole);
  dict["report"] = python_from_json(diagnosis_report_json(whole));
  return dict;
}

}  // namespace

void define_diagnosis(py::module_& module) {
  module.def("diagnose", &diagnose_folders, py::arg("folders"), py::arg("model"), py::arg("without"),
             py::arg("fidelity"), py::arg("seed"), py::arg("progress"));
}

}  // namespace fathom
