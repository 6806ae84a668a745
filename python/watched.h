// Long work, called from Python.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

namespace fathom {

namespace py = pybind11;

/// Runs `work` in a thread of its own, without Python's lock. Meanwhile this thread calls progress(what, done, total)
/// where `progress` is not None, and listens for Ctrl-C. That, and whatever `progress` throws, ends the work at its
/// next step. Throws what the work throws.
void run_watched(const py::object& progress, const std::function<void()>& work);

/// The same for work with a result.
template <class Work>
auto watched(const py::object& progress, const Work& work) {
  std::optional<decltype(work())> result;
  run_watched(progress, [&] { result.emplace(work()); });
  return std::move(*result);
}

}  // namespace fathom
