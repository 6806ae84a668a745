// A simulated sensor before a scene, and its shots.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "core/error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/objects.h"
#include "python/watched.h"
#include "sim/effects/effects_json.h"
#include "sim/render/overlap.h"
#include "sim/scene/doubts.h"
#include "sim/scene/rig.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"
#include "sim/sensor/capture_files.h"

namespace fathom {
namespace {

using ScenePath = std::optional<std::filesystem::path>;

Setup setup_of(const ScenePath& path, const Json& scene) {
  return path ? read_setup(*path) : whole_setup_from_json(scene, "scene");
}

/// The scene is a file or, where `path` is None, an object.
std::unique_ptr<Camera> camera_of(const ScenePath& path, const py::object& scene, const std::string& mode,
                                  const std::string& light, int samples, std::uint64_t seed, const ScenePath& model,
                                  const py::object& progress) {
  const Json json = json_from_python(scene, "scene");
  const auto how =
      choice_of("mode", mode, {"geometric", "photometric"}) == 0 ? CaptureMode::geometric : CaptureMode::photometric;
  const std::optional<LightModel> chosen = light_named(light);
  require_within("spp", samples, {1.0, 4096.0});
  std::vector<std::string> doubts;
  std::unique_ptr<Camera> camera = watched(progress, [&] {
    Setup setup = setup_of(path, json);
    doubts = scene_doubts(setup);
    require_apart(setup);
    if (model) setup = with_effects_of_model(std::move(setup), *model);
    return std::make_unique<Camera>(setup, how, samples, seed, chosen);
  });
  for (const std::string& doubt : doubts) warn(fmt::format("{}: {}", path ? path->string() : "scene", doubt));
  return camera;
}

py::dict shoot_frame(Camera& camera, std::uint64_t number, const py::object& progress) {
  Frame frame = watched(progress, [&] { return camera.shoot(number); });
  py::dict arrays;
  const CloudArrays cloud = arrays_of(std::move(frame.cloud));
  arrays["ir"] = frame.ir.empty() ? py::object(py::none()) : array_of(std::move(frame.ir));
  arrays["disparity_px"] = array_of(std::move(frame.disparity_px));
  arrays["depth"] = array_of(std::move(frame.depth));
  arrays["cloud"] = cloud.points;
  arrays["intensity"] = cloud.intensity;
  return arrays;
}

py::dict truth_arrays(const Camera& camera) {
  py::dict channels;
  for (ExrChannel& channel : truth_channels(camera.truth()))
    channels[py::str(channel.name)] = array_of(std::move(channel.image));
  return channels;
}

py::object record_of(const Camera& camera) {
  return python_from_json(run_record(camera, resolved_scene(camera.setup())));
}

/// A sensor's description with all its keys.
py::object whole_sensor(const py::object& sensor) {
  const Json json = json_from_python(sensor, "sensor");
  return python_from_json(json_from_rig(rig_from_json(JsonReader(json, "sensor"))));
}

}  // namespace

void define_camera(py::module_& module) {
  py::class_<Camera>(module, "Camera")
      .def(py::init(&camera_of), py::arg("path"), py::arg("scene"), py::arg("mode"), py::arg("light"), py::arg("spp"),
           py::arg("seed"), py::arg("model"), py::arg("progress"))
      .def("shoot", &shoot_frame, py::arg("frame"), py::arg("progress"))
      .def("truth", &truth_arrays)
      .def("record", &record_of)
      .def("light", [](const Camera& camera) { return name_of(camera.light()); });
  module.def("whole_sensor", &whole_sensor, py::arg("sensor"));
}

}  // namespace fathom
