#include "python/objects.h"

#include <fmt/format.h>

#include <string>

#include "core/error.h"

namespace fathom {
namespace {

/// Nested objects may hold themselves: Python's own limit ends that.
class Descent {
 public:
  Descent() {
    if (Py_EnterRecursiveCall(" while an object becomes JSON") != 0) throw py::error_already_set();
  }
  ~Descent() { Py_LeaveRecursiveCall(); }
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;
};

Json whole_number(py::handle object, const std::string& what) {
  const long long number = PyLong_AsLongLong(object.ptr());
  if (number == -1 && PyErr_Occurred()) {
    PyErr_Clear();
    throw Error(what, fmt::format("the whole number {} is too large", py::str(object).cast<std::string>()));
  }
  return number;
}

Json list_from(py::handle items, const std::string& what) {
  Json list = Json::array();
  for (const py::handle item : items) list.push_back(json_from_python(item, what));
  return list;
}

Json object_from(const py::dict& items, const std::string& what) {
  Json object = Json::object();
  for (const auto& [key, value] : items) {
    if (!py::isinstance<py::str>(key))
      throw Error(what, fmt::format("keys must be texts, got {}", py::repr(key).cast<std::string>()));
    object[key.cast<std::string>()] = json_from_python(value, what);
  }
  return object;
}

}  // namespace

py::object python_from_json(const Json& json) {
  if (json.is_boolean()) return py::bool_(json.get<bool>());
  if (json.is_number_unsigned()) return py::int_(json.get<std::uint64_t>());
  if (json.is_number_integer()) return py::int_(json.get<std::int64_t>());
  if (json.is_number()) return py::float_(json.get<double>());
  if (json.is_string()) {
    const auto& text = json.get_ref<const std::string&>();
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
  }
  if (json.is_array()) {
    py::list list;
    for (const Json& item : json) list.append(python_from_json(item));
    return list;
  }
  if (json.is_object()) {
    py::dict dict;
    for (const auto& [key, value] : json.items()) dict[py::str(key)] = python_from_json(value);
    return dict;
  }
  return py::none();
}

Json json_from_python(py::handle object, const std::string& what) {
  const Descent descent;
  if (object.is_none()) return Json();
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::isinstance<py::int_>(object)) return whole_number(object, what);
  if (py::isinstance<py::float_>(object)) return object.cast<double>();
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (py::isinstance<py::dict>(object)) return object_from(py::reinterpret_borrow<py::dict>(object), what);
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) return list_from(object, what);
  for (const char* method : {"to_dict", "tolist", "__fspath__"})
    if (py::hasattr(object, method)) return json_from_python(object.attr(method)(), what);
  throw Error(what, fmt::format("cannot hold {}", py::repr(object).cast<std::string>()));
}

void warn(const std::string& sentence) {
  if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 2) != 0) throw py::error_already_set();
}

}  // namespace fathom
