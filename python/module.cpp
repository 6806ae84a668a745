// The module fathom._fathom.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <thread>

#include "core/error.h"
#include "core/files.h"
#include "core/input_policy.h"
#include "core/library.h"
#include "python/bindings.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

/// As the program's options --threads, --max-input-mb and --allow-outside; they hold for the process.
void configure(int threads, int max_input_mb, bool allow_outside) {
  static std::optional<tbb::global_control> limit;
  static std::optional<InputPolicyScope> policy;
  require_within("threads", threads, {0.0, 1024.0});
  require_within("max_input_mb", max_input_mb, {1.0, 1e6});
  limit.reset();
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  policy.reset();
  policy.emplace(
      InputPolicy{.most_bytes = static_cast<std::uint64_t>(max_input_mb) * 1'000'000, .allow_outside = allow_outside});
}

std::vector<std::string> names_of(const std::string& library) {
  const std::vector<std::string> libraries{"cups", "effects", "media", "sensors", "solids", "walls"};
  choice_of("library", library, libraries);
  if (library != "effects") return library_names(library);
  std::vector<std::string> ids = effect_ids();
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

void require_within(const std::string& argument, double value, Range range) {
  if (!range.contains(value)) throw Error(argument, fmt::format("must be {}, got {:g}", range.text(), value));
}

std::size_t choice_of(const std::string& argument, const std::string& name, const std::vector<std::string>& choices) {
  const auto found = std::find(choices.begin(), choices.end(), name);
  if (found == choices.end()) throw Error(unknown_name(argument, name, choices));
  return static_cast<std::size_t>(found - choices.begin());
}

void define_settings(py::module_& module) {
  module.def("configure", &configure, py::arg("threads"), py::arg("max_input_mb"), py::arg("allow_outside"));
  module.def("names", &names_of, py::arg("library"));
  module.def("data_directory", &data_directory);
}

}  // namespace fathom

PYBIND11_MODULE(_fathom, module) {
  using namespace fathom;
  module.doc() = "The compiled half of fathom: what it does, the functions of fathom say.";
  module.attr("__version__") = FATHOM_VERSION;
  static PyObject* const error = py::exception<Error>(module, "Error").release().ptr();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& problem) {
      PyErr_SetString(error, problem.what());
    } catch (const std::filesystem::filesystem_error& problem) {
      PyErr_SetString(error, problem.what());
    }
  });
  define_settings(module);
  define_theory_functions(module);
  define_camera(module);
  define_detection(module);
  define_diagnosis(module);
  define_unit(module);
  define_dataset(module);
}
