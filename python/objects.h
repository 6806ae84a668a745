// JSON as Python's objects, and back.
#pragma once

#include <pybind11/pybind11.h>

#include "core/json.h"

namespace fathom {

namespace py = pybind11;

py::object python_from_json(const Json& json);

/// Of None, booleans, numbers, texts, paths, lists, tuples, dictionaries, NumPy's arrays and numbers, and whatever has
/// a method `to_dict`. Throws Error, as of `what`, on anything else.
Json json_from_python(py::handle object, const std::string& what);

/// A UserWarning of the caller's line. Throws where such warnings are errors.
void warn(const std::string& sentence);

}  // namespace fathom
