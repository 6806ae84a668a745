// Labelled frames by the thousand.
#include <fmt/format.h>

#include <filesystem>

#include "core/error.h"
#include "core/input_record.h"
#include "core/json.h"
#include "datasets/generate.h"
#include "python/bindings.h"
#include "python/objects.h"
#include "python/watched.h"

namespace fathom {
namespace {

constexpr const char* kSpec = "spec";  ///< what a specification that is no file is called

/// Of the file, or where that is None of the object, or the one that comes with the program.
DatasetSpec spec_of(const std::optional<std::filesystem::path>& file, const Json& spec, std::uint64_t seed) {
  if (file) return read_dataset_spec(*file, seed);
  if (spec.is_null()) return read_dataset_spec(shipped_dataset_spec(), seed);
  record_input(kSpec, json_text(spec));
  return dataset_spec_from_json(spec, kSpec, seed);
}

py::dict generate(const std::filesystem::path& folder, int frames, const std::optional<std::filesystem::path>& file,
                  const py::object& spec, std::uint64_t seed, int shard, int shards, const py::object& progress) {
  require_within("frames", frames, {1.0, 1e8});
  if (shards < 1 || shard < 0 || shard >= shards)
    throw Error("shard", fmt::format("must be (i, n) with i from 0 to n-1, got ({}, {})", shard, shards));
  const Json json = json_from_python(spec, kSpec);
  const MadeFrames made = watched(progress, [&] {
    const DatasetRun run = dataset_run([&] { return spec_of(file, json, seed); }, seed, frames);
    return make_frames(folder, run, {.number = shard, .count = shards}, true);
  });
  py::dict dict;
  dict["frames"] = made.frames;
  dict["made_now"] = made.made_now;
  dict["is_complete"] = made.complete;
  return dict;
}

}  // namespace

void define_dataset(py::module_& module) {
  module.def("generate", &generate, py::arg("folder"), py::arg("frames"), py::arg("file"), py::arg("spec"),
             py::arg("seed"), py::arg("shard"), py::arg("shards"), py::arg("progress"));
}

}  // namespace fathom
