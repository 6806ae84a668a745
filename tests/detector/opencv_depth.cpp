#include "tests/detector/opencv_depth.h"

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>

#include "core/error.h"

namespace fathom {
namespace {

std::string unzipped(const std::filesystem::path& path) {
  FILE* pipe = popen(("gzip -dc '" + path.string() + "'").c_str(), "r");
  if (!pipe) throw Error(path.string(), "cannot be unzipped");
  std::string text;
  char block[65536];
  for (std::size_t got; (got = std::fread(block, 1, sizeof block, pipe)) > 0;) text.append(block, got);
  if (pclose(pipe) != 0) throw Error(path.string(), "cannot be unzipped");
  return text;
}

/// What stands between <name> and </name>.
std::string element(const std::string& xml, const std::string& name, const std::filesystem::path& path) {
  const std::size_t begin = xml.find("<" + name + ">"), end = xml.find("</" + name + ">");
  if (begin == std::string::npos || end == std::string::npos) throw Error(path.string(), "has no <" + name + ">");
  return xml.substr(begin + name.size() + 2, end - begin - name.size() - 2);
}

}  // namespace

Cloud read_opencv_depth(const std::filesystem::path& path, double focal_px) {
  const std::string xml = unzipped(path);
  Cloud cloud;
  cloud.width = std::atoi(element(xml, "cols", path).c_str());
  cloud.height = std::atoi(element(xml, "rows", path).c_str());
  const std::string data = element(xml, "data", path);
  std::istringstream depths(data);
  std::string word;
  for (int y = 0; y < cloud.height; ++y)
    for (int x = 0; x < cloud.width; ++x) {
      if (!(depths >> word)) throw Error(path.string(), "has too few depths");
      const double depth = word == ".Nan" ? std::numeric_limits<double>::quiet_NaN() : std::atof(word.c_str());
      const double right = (x + 0.5 - 0.5 * cloud.width) / focal_px, down = (y + 0.5 - 0.5 * cloud.height) / focal_px;
      cloud.points.push_back((Eigen::Vector3d(right, down, 1.0) * depth).cast<float>());
    }
  return cloud;
}

}  // namespace fathom
