#include "report/kept_detection.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <vector>

#include "core/cloud_file.h"
#include "core/view_page.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDetectionRows = "detection.txt";
constexpr std::string_view kBegin = "detection_", kEnd = ".pcd";

/// Of a kept cloud its number; −1: it is another file.
int number_of(const std::string& name) {
  if (name.size() <= kBegin.size() + kEnd.size() || !name.starts_with(kBegin) || !name.ends_with(kEnd)) return -1;
  int number = -1;
  const char *begin = name.data() + kBegin.size(), *end = name.data() + name.size() - kEnd.size();
  return std::from_chars(begin, end, number).ptr == end ? number : -1;
}

}  // namespace

fs::path kept_cloud(const fs::path& folder, int number) {
  return folder / fmt::format("{}{:04}{}", kBegin, number, kEnd);
}

KeptDetection::KeptDetection(fs::path folder, int clouds)
    : folder_(std::move(folder)), owner_(folder_), clouds_(clouds) {}

void KeptDetection::add(const Cloud& cloud) {
  const int number = added_++;
  if (number == 0) {
    fs::remove(folder_ / kDetectionFile);
    fs::remove(folder_ / kDetectionRows);
    remove_view_page(folder_);
  }
  if (number >= clouds_) return;
  Image<CloudPoint> image(cloud.width, cloud.height);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3f& point = cloud.points[i];
    image.pixels()[i] = {point.x(), point.y(), point.z(),
                         cloud.intensity.empty() ? std::numeric_limits<float>::quiet_NaN() : cloud.intensity[i]};
  }
  write_pcd(kept_cloud(folder_, number), image);
}

void KeptDetection::finish(const Json& detection, std::string_view rows) const {
  std::vector<fs::path> older;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
    if (entry.is_regular_file() && number_of(entry.path().filename().string()) >= std::min(added_, clouds_))
      older.push_back(entry.path());
  for (const fs::path& cloud : older) fs::remove(cloud);
  if (!rows.empty()) write_text(folder_ / kDetectionRows, rows);
  write_json(folder_ / kDetectionFile, detection);
}

}  // namespace fathom
