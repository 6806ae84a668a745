// A capture's folder as the page's data.
#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/image_file.h"
#include "sim/render/intersect.h"
#include "sim/scene/cup.h"
#include "sim/sensor/capture_files.h"
#include "view/packed.h"
#include "view/pixel_table.h"
#include "view/scenes.h"

namespace fathom {
namespace {

Image<float> read_depth(const std::filesystem::path& file, const SensorModel& sensor) {
  check_exr(file, sensor.width, sensor.height);
  Image<float> depth = read_exr_channel(file, "Z");
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x)
      if (!std::isfinite(depth(x, y)) || depth(x, y) < 0.0f)
        throw Error(file.string(), fmt::format("pixel ({}, {})", x, y),
                    fmt::format("must be a depth in metres, or 0, got {}", depth(x, y)));
  return depth;
}

Json sensor_json(const Rig& rig) {
  const SensorModel& sensor = rig.sensor;
  const Calibration believed = sensor.calibration();
  const Eigen::Matrix3d axes = rig.world_from_camera.linear();
  return {{"camera", json_of(rig.camera_in_world())},
          {"projector", json_of(rig.projector_in_world())},
          {"axes", {json_of(axes.col(0)), json_of(axes.col(1)), json_of(axes.col(2))}},
          {"focal_baseline_m_px", sensor.focal_px * sensor.baseline},
          {"believed_focal_px", believed.focal_px},
          {"believed_principal_px", {believed.principal_px.x(), believed.principal_px.y()}}};
}

/// Each object's name and what it is: "desk", "cup", "liquid" or "thing"; a liquid's index and level, too.
Json objects_json(const Geometry& geometry) {
  Json objects = Json::array();
  for (const std::string& name : geometry.objects) objects.push_back({{"name", name}, {"kind", "desk"}});
  const auto object = [&](int number) -> Json& { return objects[static_cast<std::size_t>(number) - 1]; };
  for (const int thing : geometry.things) object(thing)["kind"] = "thing";
  for (const CupObjects& cup : geometry.cups) {
    object(cup.cup)["kind"] = "cup";
    if (cup.liquid) object(*cup.liquid)["kind"] = "liquid";
  }
  for (const Body& body : geometry.bodies) {
    object(body.object)["index"] = body.medium.n;
    if (body.level) object(body.object)["level_m"] = *body.level;
  }
  return objects;
}

/// The surfaces of all but the desk, as far as a page has room for them; `left_out` gets the names of the others.
Json meshes_json(const Geometry& geometry, const Json& objects, const PlaceCode& code, Json& left_out) {
  constexpr std::size_t kMostTriangles = 150'000;
  std::size_t triangles = 0;
  Json meshes = Json::array();
  for (const Surface& surface : geometry.surfaces) {
    const Json& object = objects[static_cast<std::size_t>(surface.object) - 1];
    if (object["kind"] == "desk") continue;
    if (triangles + surface.mesh.triangles.size() > kMostTriangles) {
      left_out.push_back(object["name"]);
      continue;
    }
    triangles += surface.mesh.triangles.size();
    std::vector<std::int16_t> vertices;
    for (const Eigen::Vector3d& vertex : surface.mesh.vertices) code.add(vertex, vertices);
    std::vector<std::uint32_t> corners;
    for (const Eigen::Vector3i& triangle : surface.mesh.triangles)
      for (const int corner : triangle) corners.push_back(static_cast<std::uint32_t>(corner));
    meshes.push_back({{"object", surface.object}, {"vertices", packed(vertices)}, {"corners", packed(corners)}});
  }
  return meshes;
}

/// [m] greatest coordinate of the sensor and of all surfaces but the desk, by amount.
double reach_of(const Geometry& geometry, const Rig& rig) {
  double most = rig.camera_in_world().cwiseAbs().maxCoeff();
  for (const Surface& surface : geometry.surfaces)
    for (const Eigen::Vector3d& vertex : surface.mesh.vertices) most = std::max(most, vertex.cwiseAbs().maxCoeff());
  return most;
}

/// What a visitor wants to see first: the first cup with something in it, else the first cup.
Json focus_json(const Scene& scene) {
  const Cup* chosen = nullptr;
  for (const Cup& cup : scene.cups)
    if (!chosen || (cup.filling && !chosen->filling)) chosen = &cup;
  if (!chosen) return {};
  return {chosen->position.x(), chosen->position.y(), chosen->filling ? liquid_level(*chosen) : 0.0};
}

}  // namespace

Json capture_scene(const std::filesystem::path& folder, int frame) {
  const RecordedCapture capture = read_capture(folder);
  const int frames = static_cast<int>(capture.frames.size());
  if (frame >= frames)
    throw Error(folder.string(), fmt::format("has {} frames, so --frame must be at most {}", frames, frames - 1));
  if (capture.setup.processing.colour_view)
    throw Error(folder.string(), "has depths in the colour camera's view, where a pixel has no ray of its own");
  const Rig& rig = capture.setup.rig;
  const Image<float> depth = read_depth(capture.frames[static_cast<std::size_t>(frame)] / "depth.exr", rig.sensor);
  const Geometry geometry = build_geometry(capture.setup.scene, rig.sensor.wavelength_nm);
  const Intersector world(geometry);
  const PixelTable pixels = trace_pixels(capture.setup, PointLight(world, rig.projector_in_world()), depth);
  const PlaceCode code(std::max(pixels.farthest(), reach_of(geometry, rig)));
  const Json objects = objects_json(geometry);
  Json left_out = Json::array();
  Json meshes = meshes_json(geometry, objects, code, left_out);
  return {{"step_m", code.step()},
          {"infrared", capture.infrared},
          {"desk", capture.setup.scene.desk.has_value()},
          {"sensor", sensor_json(rig)},
          {"objects", objects},
          {"focus", focus_json(capture.setup.scene)},
          {"meshes", std::move(meshes)},
          {"left_out", std::move(left_out)},
          {"pixels", json_from_pixels(pixels, code)}};
}

}  // namespace fathom
