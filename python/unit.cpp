// How one device differs from its model.
#include <algorithm>
#include <filesystem>
#include <variant>

#include "core/error.h"
#include "core/folder_owner.h"
#include "diagnosis/unit/calibration.h"
#include "diagnosis/unit/calibration_clouds.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/watched.h"
#include "report/unit_report.h"

namespace fathom {
namespace {

UnitCalibration calibrate_files(const std::vector<std::filesystem::path>& files, const std::optional<double>& height_mm,
                                const std::optional<double>& pitch_deg, const std::optional<double>& focal_px,
                                const std::optional<double>& interval_s, const std::optional<bool>& registered,
                                const py::object& progress) {
  if (focal_px) require_within("focal_px", *focal_px, {1.0, 1e6});
  if (interval_s) require_within("interval_s", *interval_s, kPositive);
  const CalibrationOptions options{
      .mounted = prior_of(height_mm, pitch_deg), .focal_px = focal_px, .registered = registered};
  return watched(progress, [&] {
    const std::vector<CalibrationCloud> clouds = calibration_clouds(files, interval_s);
    if (clouds.empty()) throw Error("clouds", "must name at least one cloud");
    return calibrate(clouds, options);
  });
}

/// An image of the calibration, which lives as long as that does.
template <class T>
py::array_t<T> view_of(const UnitCalibration& unit, const Image<T>& image) {
  return py::array_t<T>({image.height(), image.width()}, image.pixels().data(), py::cast(&unit));
}

/// Where any view has desk; characters of C++ are whole numbers of NumPy.
py::array_t<bool> seen_of(const UnitCalibration& unit) {
  py::array_t<bool> seen({unit.seen.height(), unit.seen.width()});
  std::transform(unit.seen.pixels().begin(), unit.seen.pixels().end(), seen.mutable_data(),
                 [](char pixel) { return pixel != 0; });
  return seen;
}

py::dict facts_of(const UnitCalibration& unit) {
  py::dict facts;
  for (const Row& row : unit_rows(unit)) {
    const std::string name = row.unit.empty() ? row.name : row.name + " [" + row.unit + "]";
    facts[py::str(name)] = std::visit([](const auto& value) { return py::object(py::cast(value)); }, row.value);
  }
  return facts;
}

void save(const UnitCalibration& unit, const std::filesystem::path& folder) {
  watched(py::none(), [&] {
    const FolderOwner owner(folder);
    write_unit(folder, unit);
    return true;
  });
}

}  // namespace

void define_unit(py::module_& module) {
  py::class_<UnitCalibration>(module, "Unit")
      .def("bias_px", [](const UnitCalibration& unit) { return view_of(unit, unit.bias_px); })
      .def("sigma_px", [](const UnitCalibration& unit) { return view_of(unit, unit.sigma_px); })
      .def("reference_px", [](const UnitCalibration& unit) { return view_of(unit, unit.reference_px); })
      .def("camera_px", [](const UnitCalibration& unit) { return view_of(unit, unit.camera_px); })
      .def("seen", &seen_of)
      .def("facts", &facts_of)
      .def("save", &save, py::arg("folder"));
  module.def("calibrate", &calibrate_files, py::arg("files"), py::arg("height_mm"), py::arg("pitch_deg"),
             py::arg("focal_px"), py::arg("interval_s"), py::arg("registered"), py::arg("progress"));
}

}  // namespace fathom
