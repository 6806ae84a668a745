#include "app/poses.h"

#include <fmt/format.h>

#include <Eigen/LU>

#include "core/json.h"

namespace fathom {
namespace {

Pose read_pose(const JsonReader& json) {
  const std::vector<JsonReader> rows = json.items();
  if (rows.size() != 3) json.fail("must be three rows [r, r, r, metres]");
  Pose pose = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    const std::vector<double> row = rows[i].numbers();
    if (row.size() != 4) rows[i].fail("must be four numbers: a row of the rotation and a coordinate in metres");
    for (int k = 0; k < 3; ++k) pose.linear()(i, k) = row[k];
    pose.translation()[i] = row[3];
  }
  constexpr double kRounded = 1e-3;  // of numbers with four digits
  const Eigen::Matrix3d rotation = pose.linear();
  if (!(rotation * rotation.transpose()).isIdentity(kRounded) || rotation.determinant() < 0.0)
    json.fail("is no rotation: its rows must be orthogonal, of length 1 and right-handed");
  return pose;
}

}  // namespace

std::vector<Pose> read_poses(const std::filesystem::path& path, std::size_t count) {
  const Json json = read_json(path);
  const JsonReader reader(json, path.string());
  reader.allow_only({"world_from_camera"});
  std::vector<Pose> poses;
  for (const JsonReader& item : reader.at("world_from_camera").items()) poses.push_back(read_pose(item));
  if (poses.size() != count)
    reader.fail_at("world_from_camera", fmt::format("has {} poses for {} clouds", poses.size(), count));
  return poses;
}

}  // namespace fathom
