// What the module _fathom is made of: a function for each of its files. Python's side (fathom/) gives all of it names,
// types and docstrings.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <string>
#include <vector>

#include "core/range.h"
#include "detector/plane.h"

namespace fathom {

namespace py = pybind11;

void define_settings(py::module_& module);
void define_theory_functions(py::module_& module);
void define_camera(py::module_& module);
void define_detection(py::module_& module);
void define_diagnosis(py::module_& module);
void define_unit(py::module_& module);
void define_dataset(py::module_& module);

/// Throws Error unless an argument is within its range.
void require_within(const std::string& argument, double value, Range range);

/// The place of `name` among `choices`. Throws Error with these.
std::size_t choice_of(const std::string& argument, const std::string& name, const std::vector<std::string>& choices);

/// Where the desk is; nothing where both are None. Throws Error where one is, or a number is out of range.
std::optional<DeskPrior> prior_of(const std::optional<double>& height_mm, const std::optional<double>& pitch_deg);

}  // namespace fathom
