// Clouds, and cups in them.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cstring>

#include "core/error.h"
#include "core/units.h"
#include "detector/read_cloud.h"
#include "detector/settings_json.h"
#include "diagnosis/measurement/calibrated_unit.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/objects.h"
#include "python/watched.h"
#include "report/detection_report.h"

namespace fathom {
namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

/// Points n × 3 or h × w × 3, and perhaps as many intensities.
Cloud cloud_from(const Floats& points, const std::optional<Floats>& intensity) {
  const bool is_image = points.ndim() == 3;
  if ((points.ndim() != 2 && !is_image) || points.shape(points.ndim() - 1) != 3)
    throw Error("cloud",
                fmt::format("must be n x 3 or h x w x 3 points in metres, got the shape {}", shape_text(points)));
  constexpr py::ssize_t kMost = 1 << 30;
  const py::ssize_t count = points.size() / 3;
  if (count > kMost) throw Error("cloud", fmt::format("has {} points, at most {} are read", count, kMost));
  Cloud cloud;
  cloud.width = static_cast<int>(is_image ? points.shape(1) : count);
  cloud.height = static_cast<int>(is_image ? points.shape(0) : 1);
  cloud.points.resize(static_cast<std::size_t>(count));
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  if (count > 0) std::memcpy(cloud.points.front().data(), points.data(), static_cast<std::size_t>(points.nbytes()));
  if (intensity) {
    if (intensity->size() != count)
      throw Error("intensity", fmt::format("must be one number for each of {} points, got the shape {}", count,
                                           shape_text(*intensity)));
    cloud.intensity.assign(intensity->data(), intensity->data() + count);
  }
  take_as_measured(cloud);
  return cloud;
}

py::array_t<float> array_of_points(const Points& points) {
  py::array_t<float> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  if (!points.empty()) std::memcpy(array.mutable_data(), points.front().data(), points.size() * sizeof points.front());
  return array;
}

py::tuple read_cloud_arrays(const std::filesystem::path& path) {
  Cloud cloud = watched(py::none(), [&] { return read_cloud(path); });
  const bool has_intensity = !cloud.intensity.empty();
  py::array points = array_of_points(cloud.points);
  if (cloud.height > 1) points = points.reshape({cloud.height, cloud.width, 3});
  py::object intensity = py::none();
  if (has_intensity) {
    py::array numbers = array_of(std::move(cloud.intensity));
    intensity = cloud.height > 1 ? numbers.reshape({cloud.height, cloud.width}) : numbers;
  }
  return py::make_tuple(points, intensity);
}

/// A segment's points in the camera's frame.
Points in_camera(const CupCandidate& candidate, const Eigen::Isometry3d& camera_from_desk) {
  Points points = candidate.points;
  const Eigen::Isometry3f turn = camera_from_desk.cast<float>();
  for (Eigen::Vector3f& point : points) point = turn * point;
  return points;
}

/// What `detect --json` says, and the points of the cups.
py::dict dict_of(const Detection& detection) {
  py::dict dict = python_from_json(detection_json(detection)).cast<py::dict>();
  if (!detection.desk) return dict;
  const Eigen::Isometry3d desk = desk_from_camera(detection.desk->plane);
  py::array_t<double> matrix({4, 4});
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix.mutable_data()) = desk.matrix();
  dict["desk_from_camera"] = matrix;
  const py::list cups = dict["cups"];
  for (std::size_t i = 0; i < detection.cups.size(); ++i) {
    cups[i]["points_inside"] = cups[i]["points"];
    cups[i]["points"] = array_of_points(in_camera(detection.cups[i].candidate, desk.inverse()));
  }
  return dict;
}

py::dict detect(const Floats& points, const std::optional<Floats>& intensity, const std::string& method,
                const std::optional<double>& height_mm, const std::optional<double>& pitch_deg,
                const std::optional<std::filesystem::path>& unit,
                const std::optional<std::filesystem::path>& config_file, const py::object& config) {
  Cloud cloud = cloud_from(points, intensity);
  if (const std::string doubt = doubt_of_units(cloud); !doubt.empty()) warn("cloud: " + doubt);
  const Method& chosen = method_named(method);
  const std::optional<DeskPrior> prior = prior_of(height_mm, pitch_deg);
  const Json keys = config.is_none() ? Json::object() : json_from_python(config, "config");
  const Detection detection = watched(py::none(), [&] {
    DetectorSettings settings =
        config_file ? read_detector_settings(*config_file) : detector_settings(JsonReader(keys, "config"));
    settings.prior = prior;
    if (unit) CalibratedUnit(*unit).take_off_bias(cloud.points);
    return chosen.detect(cloud, settings);
  });
  return dict_of(detection);
}

}  // namespace

std::optional<DeskPrior> prior_of(const std::optional<double>& height_mm, const std::optional<double>& pitch_deg) {
  if (height_mm.has_value() != pitch_deg.has_value())
    throw Error("height_mm and pitch_deg", "belong together: give both");
  if (!height_mm) return std::nullopt;
  require_within("height_mm", *height_mm, {1.0, 1e5});
  require_within("pitch_deg", *pitch_deg, {-90.0, 90.0});
  return DeskPrior{metres_from_mm(*height_mm), radians_from_deg(*pitch_deg)};
}

void define_detection(py::module_& module) {
  module.def("read_cloud", &read_cloud_arrays, py::arg("path"));
  module.def("detect", &detect, py::arg("points"), py::arg("intensity"), py::arg("method"), py::arg("height_mm"),
             py::arg("pitch_deg"), py::arg("unit"), py::arg("config_file"), py::arg("config"));
}

}  // namespace fathom
