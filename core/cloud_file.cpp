#include "core/cloud_file.h"

#include <fmt/format.h>

#include <fstream>

#include "core/error.h"
#include "core/files.h"

namespace fathom {
namespace {

std::string header_of(int width, int height) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\n"
      "COUNT 1 1 1 1\nWIDTH {}\nHEIGHT {}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      width, height, static_cast<std::size_t>(width) * height);
}

}  // namespace

void put_pcd(const std::filesystem::path& path, const Image<CloudPoint>& cloud) {
  static_assert(sizeof(CloudPoint) == 16, "the binary body is the array itself");
  std::ofstream file(path, std::ios::binary);
  file << header_of(cloud.width(), cloud.height());
  file.write(reinterpret_cast<const char*>(cloud.pixels().data()),
             static_cast<std::streamsize>(cloud.size() * sizeof(CloudPoint)));
  file.close();
  if (!file) throw Error(path.string(), "cannot be written: disk full or not writable");
}

void write_pcd(const std::filesystem::path& path, const Image<CloudPoint>& cloud) {
  write_atomically(path, [&](const std::filesystem::path& beside) { put_pcd(beside, cloud); });
}

}  // namespace fathom
