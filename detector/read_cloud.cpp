#include "detector/read_cloud.h"

#include <fmt/format.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

#include "core/error.h"
#include "detector/cloud_header.h"
#include "detector/quiet_pcl.h"

namespace fathom {
namespace {

template <class T>
float value_as(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<float>(value);
}

float number_at(const std::uint8_t* bytes, std::uint8_t type) {
  switch (type) {
    case pcl::PCLPointField::INT8:
      return value_as<std::int8_t>(bytes);
    case pcl::PCLPointField::UINT8:
      return value_as<std::uint8_t>(bytes);
    case pcl::PCLPointField::INT16:
      return value_as<std::int16_t>(bytes);
    case pcl::PCLPointField::UINT16:
      return value_as<std::uint16_t>(bytes);
    case pcl::PCLPointField::INT32:
      return value_as<std::int32_t>(bytes);
    case pcl::PCLPointField::UINT32:
      return value_as<std::uint32_t>(bytes);
    case pcl::PCLPointField::FLOAT32:
      return value_as<float>(bytes);
    case pcl::PCLPointField::FLOAT64:
      return value_as<double>(bytes);
    default:
      return std::numeric_limits<float>::quiet_NaN();
  }
}

std::optional<pcl::PCLPointField> field_named(const pcl::PCLPointCloud2& raw, const char* name) {
  for (const pcl::PCLPointField& field : raw.fields)
    if (field.name == name) return field;
  return std::nullopt;
}

/// PCL's readers report some damage by their result, some by exceptions and some not at all.
std::optional<pcl::PCLPointCloud2> read_raw(const std::filesystem::path& path, CloudFormat format) {
  const QuietPcl quiet;
  pcl::PCLPointCloud2 raw;
  try {
    const int problem = format == CloudFormat::kPcd ? pcl::PCDReader().read(path.string(), raw)
                                                    : pcl::PLYReader().read(path.string(), raw);
    if (problem < 0) return std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;
  }
  const std::uint64_t count = static_cast<std::uint64_t>(raw.width) * raw.height;
  if (raw.data.size() < count * raw.point_step) return std::nullopt;
  return raw;
}

void turn_if_behind(Points& points) {
  if (std::any_of(points.begin(), points.end(), [](const Eigen::Vector3f& point) { return point.z() >= 0.0f; })) return;
  for (Eigen::Vector3f& point : points) point.tail<2>() *= -1.0f;
}

}  // namespace

Cloud read_cloud(const std::filesystem::path& path) {
  const std::optional<pcl::PCLPointCloud2> read = read_raw(path, check_cloud_header(path));
  if (!read) throw Error(path.string(), "cannot be read: its points are damaged or cut short");
  const pcl::PCLPointCloud2& raw = *read;
  const auto x = field_named(raw, "x"), y = field_named(raw, "y"), z = field_named(raw, "z");
  if (!x || !y || !z) throw Error(path.string(), "cannot be read: its points have no x, y, z");
  const auto intensity = field_named(raw, "intensity");

  Cloud cloud;
  cloud.width = static_cast<int>(raw.width);
  cloud.height = static_cast<int>(raw.height);
  const std::size_t count = static_cast<std::size_t>(raw.width) * raw.height;
  cloud.points.reserve(count);
  if (intensity) cloud.intensity.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* bytes = raw.data.data() + i * raw.point_step;
    const auto number = [&](const pcl::PCLPointField& field) {
      return number_at(bytes + field.offset, field.datatype);
    };
    Eigen::Vector3f point(number(*x), number(*y), number(*z));
    if (!point.allFinite() || point.isZero(0.0f)) point.setConstant(std::numeric_limits<float>::quiet_NaN());
    cloud.points.push_back(point);
    if (intensity) cloud.intensity.push_back(number(*intensity));
  }
  turn_if_behind(cloud.points);
  return cloud;
}

}  // namespace fathom
