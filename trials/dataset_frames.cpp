#include "trials/dataset_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/files.h"
#include "core/image_file.h"
#include "core/units.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFrames = 1'000'000;  // of one folder: names have six digits

/// Millimetres in the file.
Eigen::Vector3d metres(const JsonReader& json) { return kMetresPerMm * json.vector3({-1e6, 1e6}); }

Eigen::Matrix3d rotation_by_rows(const JsonReader& json) {
  constexpr double kRounding = 1e-6;
  const std::vector<double> numbers = json.numbers({-1.0, 1.0});
  if (numbers.size() != 9) json.fail("must be nine numbers, row by row");
  const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data());
  if (!(rotation * rotation.transpose()).isIdentity(kRounding) || rotation.determinant() < 0.0)
    json.fail("must be a rotation");
  return rotation;
}

Cloud cloud_of(const Image<std::uint16_t>& counts, double unit_m, double focal_px,
               const Eigen::Vector2d& principal_px) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  Cloud cloud{.points = Points(counts.size(), {kNone, kNone, kNone}),
              .intensity = {},
              .width = counts.width(),
              .height = counts.height()};
  for (int y = 0; y < counts.height(); ++y)
    for (int x = 0; x < counts.width(); ++x) {
      if (counts(x, y) == 0) continue;
      const double depth = unit_m * counts(x, y);
      const Eigen::Vector2d across = (Eigen::Vector2d(x + 0.5, y + 0.5) - principal_px) / focal_px * depth;
      cloud.points[static_cast<std::size_t>(y) * counts.width() + x] =
          Eigen::Vector3d(across.x(), across.y(), depth).cast<float>();
    }
  return cloud;
}

/// Gives the pixels of COCO's runs, which go down the columns, to an owner.
void own(const JsonReader& runs, int owner, Image<int>& owners) {
  const std::vector<double> size = runs.at("size").numbers();
  if (size != std::vector<double>{static_cast<double>(owners.height()), static_cast<double>(owners.width())})
    runs.fail_at("size", "must be the depth image's height and width");
  std::size_t pixel = 0;
  bool is_inside = false;
  for (const double count : runs.at("counts").numbers({0.0, static_cast<double>(owners.size())})) {
    const std::size_t end = pixel + static_cast<std::size_t>(count);
    if (end > owners.size()) runs.fail_at("counts", "must not go beyond the image");
    for (; pixel < end; ++pixel)
      if (is_inside)
        owners(static_cast<int>(pixel / owners.height()), static_cast<int>(pixel % owners.height())) = owner;
    is_inside = !is_inside;
  }
}

TrialCup true_cup(const JsonReader& instance, const Pose& world_from_camera) {
  const JsonReader cup = instance.at("cup");
  const Eigen::Vector3d foot = metres(instance.at("pose").at("cam_t_m2c"));
  TrialCup result;
  result.shape = cup.text("name");
  result.position_mm = (world_from_camera * foot).head<2>() / kMetresPerMm;
  result.distance_mm = mm_from_metres(foot.norm());
  result.visible = instance.at("info").number("visib_fract", {0.0, 1.0});
  if (cup.at("liquid").value().is_null()) {
    result.liquid = "empty";
    return result;
  }
  const JsonReader liquid = cup.at("liquid");
  result.liquid = liquid.text("name");
  result.fill_mm = liquid.number("fill_mm", {0.0, 1e6, true});
  result.kind = name_of(liquid.text("category") == "liquid surface" ? LiquidKind::kOpaque : LiquidKind::kTransparent);
  return result;
}

}  // namespace

DatasetFrames::DatasetFrames(fs::path folder) : folder_(std::move(folder)) {
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "train", missing)) {
    const fs::path complete = entry.path() / "complete.json";
    if (!fs::exists(complete)) continue;
    const Json json = read_json(complete);
    scenes_.push_back(
        {entry.path().filename().string(), JsonReader(json, complete.string()).at("frames").integer(1, kMostFrames)});
  }
  if (scenes_.empty()) throw Error(folder_.string(), "holds no frames that fathom generate has completed");
  std::sort(scenes_.begin(), scenes_.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  const fs::path models = folder_ / "models/models_info.json";
  const Json info = read_json(models);
  for (const auto& [id, model] : info.items())
    names_[std::atoi(id.c_str())] = JsonReader(model, models.string(), "/" + id).text("name");
}

fs::path DatasetFrames::manifest_of(const SceneFolder& scene) const {
  return folder_ / "train" / scene.name / "manifest.jsonl";
}

LabelledFrame DatasetFrames::read(const SceneFolder& scene, int image) const {
  const fs::path folder = folder_ / "train" / scene.name, file = folder / fmt::format("labels/{:06}.json", image);
  const Json labels = read_json(file);
  const JsonReader json(labels, file.string()), camera = json.at("camera");
  const std::vector<double> matrix = camera.at("cam_K").numbers({-1e6, 1e6});
  if (matrix.size() != 9 || matrix[0] < 1.0)
    camera.fail_at("cam_K", "must be the nine numbers of a camera matrix [px], first the focal length");
  const Image<std::uint16_t> depth = read_png_grey(folder / fmt::format("depth/{:06}.png", image));

  Pose camera_from_world = Pose::Identity();
  camera_from_world.linear() = rotation_by_rows(camera.at("cam_R_w2c"));
  camera_from_world.translation() = metres(camera.at("cam_t_w2c"));
  LabelledFrame frame{.sensor = json.at("scene").at("sensor").text_or("model", ""),
                      .world_from_camera = camera_from_world.inverse(),
                      .focal_px = matrix[0],
                      .principal_px = Eigen::Vector2d(matrix[2] + 0.5, matrix[5] + 0.5),
                      .owners = Image<int>(depth.width(), depth.height(), LabelledFrame::kNobody)};
  frame.cloud =
      cloud_of(depth, kMetresPerMm * camera.number("depth_scale", {1e-3, 1e3}), frame.focal_px, frame.principal_px);
  int owner = 0;
  for (const JsonReader& instance : json.at("instances").items()) {
    own(instance.at("visible"), owner++, frame.owners);
    if (!instance.has("cup")) {
      const auto name = names_.find(instance.at("pose").at("obj_id").integer(0, kMostFrames));
      frame.others.push_back(name == names_.end() ? "thing" : name->second);
    } else if (frame.others.empty()) {
      frame.cups.push_back(true_cup(instance, frame.world_from_camera));
    } else {
      instance.fail("must stand before the things that are no cups");
    }
  }
  return frame;
}

}  // namespace fathom
