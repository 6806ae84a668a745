#include "detector/read_cloud.h"

#include <fmt/format.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/files.h"
#include "detector/pcd_header.h"
#include "detector/quiet_pcl.h"
#include "detector/read_ply.h"

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

/// PCL's reader reports some damage by its result, some by exceptions and some not at all. It is given the file's
/// content, not its name, so that what it reads is what was checked.
std::optional<pcl::PCLPointCloud2> read_raw(std::string_view content, const PcdHeader& header) {
  const QuietPcl quiet;
  pcl::PCLPointCloud2 raw;
  try {
    pcl::PCDReader reader;
    std::istringstream head{std::string(content.substr(0, header.body))};
    Eigen::Vector4f origin;
    Eigen::Quaternionf orientation;
    int version = 0, encoding = 0;
    unsigned int body = 0;
    if (reader.readHeader(head, raw, origin, orientation, version, encoding, body) < 0) return std::nullopt;
    const std::uint64_t count = static_cast<std::uint64_t>(raw.width) * raw.height;
    if (body != header.body || raw.data.size() != header.raw_bytes || count * raw.point_step != header.raw_bytes)
      return std::nullopt;
    constexpr int kText = 0, kPacked = 2;
    std::istringstream text{encoding == kText ? std::string(content.substr(body)) : std::string()};
    const int problem = encoding == kText
                            ? reader.readBodyASCII(text, raw, version)
                            : reader.readBodyBinary(reinterpret_cast<const unsigned char*>(content.data()), raw,
                                                    version, encoding == kPacked, body);
    if (problem < 0 || raw.data.size() != header.raw_bytes) return std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return raw;
}

Cloud read_pcd(const std::string& file, std::string_view content) {
  const std::optional<pcl::PCLPointCloud2> read = read_raw(content, check_pcd(file, content));
  if (!read) throw Error(file, "cannot be read: its points are damaged or cut short");
  const pcl::PCLPointCloud2& raw = *read;
  const auto x = field_named(raw, "x"), y = field_named(raw, "y"), z = field_named(raw, "z");
  if (!x || !y || !z) throw Error(file, "cannot be read: its points have no x, y, z");
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
    cloud.points.emplace_back(number(*x), number(*y), number(*z));
    if (intensity) cloud.intensity.push_back(number(*intensity));
  }
  return cloud;
}

}  // namespace

Cloud read_cloud(const std::filesystem::path& path) {
  const std::string content = read_text(path), file = path.string();
  const std::string_view start = std::string_view(content).substr(0, 8);
  const auto starts = [&](std::string_view word) { return start.starts_with(word); };
  if (content.empty()) throw Error(file, "is empty, expected a PCD or PLY cloud");
  const bool ply = starts("ply\n") || starts("ply\r\n");
  if (!ply && !starts("#") && !starts("VERSION") && !starts("FIELDS")) throw Error(file, "is neither PCD nor PLY");
  Cloud cloud = ply ? read_ply(file, content) : read_pcd(file, content);
  take_as_measured(cloud);
  return cloud;
}

std::string doubt_of_units(const Cloud& cloud) {
  constexpr float kFar_m = 50.0f;  // beyond what such a camera measures; in millimetres it would be too near
  std::ptrdiff_t far = 0, near = 0;
  for (const Eigen::Vector3f& point : cloud.points) {
    far += point.z() > kFar_m;
    near += point.z() <= kFar_m;
  }
  if (far <= near) return {};
  return fmt::format("most points lie more than {:g} m away; clouds are in metres, is this one in millimetres?",
                     kFar_m);
}

}  // namespace fathom
