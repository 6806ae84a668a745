#include "sim/scene/doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/json.h"

namespace fathom {
namespace {

/// Whether a length is below the limit and not 0. Of a place all coordinates are below, and not all are 0.
bool is_tiny(const Json& value, double limit_mm) {
  const auto below = [&](const Json& number) {
    return number.is_number() && std::fabs(number.get<double>()) < limit_mm;
  };
  const auto is_zero = [](const Json& number) { return number == 0; };
  if (!value.is_array()) return below(value) && !is_zero(value);
  return std::all_of(value.begin(), value.end(), below) && !std::all_of(value.begin(), value.end(), is_zero);
}

void doubt_length(const Json& object, const std::string& place, const char* key, double limit_mm,
                  std::vector<std::string>& sentences) {
  if (!object.is_object() || !object.contains(key) || !is_tiny(object[key], limit_mm)) return;
  sentences.push_back(
      fmt::format("{}/{}: {} mm; lengths are in millimetres, were metres meant?", place, key, object[key].dump()));
}

/// Whether the camera's image, without distortion, has a point of the cup's outside: of its rim or its base.
bool is_in_image(const Rig& rig, const Cup& cup) {
  std::vector<Eigen::Vector3d> points;
  if (const auto* mesh = std::get_if<MeshCup>(&cup.shape)) {
    for (const GltfPart& part : mesh->parts)
      points.insert(points.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
  } else {
    constexpr int kAround = 16;
    const CupShape& shape = std::get<CupShape>(cup.shape);
    for (const Eigen::Vector2d& at : {shape.outer.front(), shape.outer.back()})
      for (int i = 0; i < kAround; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kAround, radius = shape.outer_radius(at.y());
        points.emplace_back(cup.position.x() + radius * std::cos(angle), cup.position.y() + radius * std::sin(angle),
                            at.y());
      }
  }
  const SensorModel& sensor = rig.sensor;
  return std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    const auto at = rig.rectified(point - rig.camera_in_world());
    if (!at) return false;
    const Eigen::Vector2d px = sensor.principal_px + sensor.focal_px * *at;
    return px.x() >= 0.0 && px.y() >= 0.0 && px.x() <= sensor.width && px.y() <= sensor.height;
  });
}

std::vector<std::string> doubts_of_lengths(const Json& scene) {
  std::vector<std::string> sentences;
  if (scene.contains("sensor"))
    for (const char* key : {"height_mm", "aim_mm"}) doubt_length(scene["sensor"], "/sensor", key, 10.0, sentences);
  if (!scene.contains("cups")) return sentences;
  for (std::size_t i = 0; i < scene["cups"].size(); ++i) {
    const Json& cup = scene["cups"][i];
    const std::string place = fmt::format("/cups/{}", i);
    for (const char* key : {"position_mm", "fill_mm"}) doubt_length(cup, place, key, 1.0, sentences);
    if (!cup.contains("shape")) continue;
    for (const char* key : {"height_mm", "inner_radius_mm", "outer_radius_mm"})
      doubt_length(cup["shape"], place + "/shape", key, 1.0, sentences);
  }
  return sentences;
}

}  // namespace

std::vector<std::string> scene_doubts(const Setup& setup) {
  std::vector<std::string> sentences = doubts_of_lengths(setup.source);
  std::vector<std::string> outside;
  for (std::size_t i = 0; i < setup.scene.cups.size(); ++i)
    if (!is_in_image(setup.rig, setup.scene.cups[i])) outside.push_back(fmt::format("/cups/{}", i));
  if (!outside.empty())
    sentences.push_back(fmt::format("{}: {} outside the camera's image; /sensor/aim_mm says where it looks",
                                    name_list(outside), outside.size() > 1 ? "are" : "is"));
  return sentences;
}

}  // namespace fathom
