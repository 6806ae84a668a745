#include "detector/read_cloud.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/files.h"
#include "core/input_policy.h"
#include "core/rng.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

struct CloudFiles : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override { make_directory(folder); }
  void TearDown() override { fs::remove_all(folder); }

  fs::path written(const std::string& name, const std::string& content) {
    write_text(folder / name, content);
    return folder / name;
  }
  /// What follows the file's name in the error, or "" when the file is read.
  std::string error_of(const std::string& content) {
    const fs::path path = written("cloud.pcd", content);
    try {
      read_cloud(path);
    } catch (const Error& problem) {
      const std::string text = problem.what();
      EXPECT_TRUE(text.starts_with(path.string() + ": ")) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      return text.substr(path.string().size() + 2);
    }
    return "";
  }
};

pcl::PointCloud<pcl::PointXYZI> four_points() {
  pcl::PointCloud<pcl::PointXYZI> cloud(2, 2);
  for (int i = 0; i < 4; ++i) {
    const float f = static_cast<float>(i);
    cloud[static_cast<std::size_t>(i)].getVector3fMap() = Eigen::Vector3f(f, 0.5f * f, 1.0f + f);
    cloud[static_cast<std::size_t>(i)].intensity = 10.0f * f;
  }
  cloud[2].x = kNaN;
  cloud[3].getVector3fMap().setZero();
  return cloud;
}

void expect_four_points(const Cloud& cloud) {
  ASSERT_EQ(cloud.points.size(), 4u);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(0.0f, 0.0f, 1.0f));
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(1.0f, 0.5f, 2.0f));
  EXPECT_TRUE(cloud.points[2].array().isNaN().all());
  EXPECT_TRUE(cloud.points[3].array().isNaN().all()) << "(0, 0, 0) is no measurement";
  EXPECT_EQ(finite_points(cloud).size(), 2u);
  ASSERT_EQ(cloud.intensity.size(), 4u);
  EXPECT_EQ(cloud.intensity[1], 10.0f);
  EXPECT_EQ(cloud.intensity[3], 30.0f);
}

TEST_F(CloudFiles, EveryEncodingOfPcdGivesTheSameOrganisedPoints) {
  const std::string path = (folder / "cloud.pcd").string();
  pcl::PCDWriter writer;
  const auto cloud = four_points();
  for (int encoding = 0; encoding < 3; ++encoding) {
    if (encoding == 0) writer.writeASCII(path, cloud);
    if (encoding == 1) writer.writeBinary(path, cloud);
    if (encoding == 2) writer.writeBinaryCompressed(path, cloud);
    const Cloud read = read_cloud(path);
    EXPECT_EQ(read.width, 2);
    EXPECT_EQ(read.height, 2);
    expect_four_points(read);
  }
}

TEST_F(CloudFiles, BothEncodingsOfPlyGiveTheSamePoints) {
  const std::string path = (folder / "cloud.ply").string();
  for (const bool binary : {false, true}) {
    pcl::PLYWriter().write(path, four_points(), binary, false);
    expect_four_points(read_cloud(path));
  }
}

TEST_F(CloudFiles, OtherFieldsAndTypesDoNotMatter) {
  const std::string pcd =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS label y rgb x normal z\nSIZE 2 8 4 8 4 8\nTYPE U F U F F F\nCOUNT 1 1 1 1 3 1\n"
      "WIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 0 1 0 0\nPOINTS 1\nDATA ascii\n7 0.25 255 -0.5 0 0 1 1.5\n";
  EXPECT_EQ(read_cloud(written("a.pcd", pcd)).points.at(0), Eigen::Vector3f(-0.5f, 0.25f, 1.5f));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar red\nproperty uchar green\nproperty uchar "
      "blue\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n7 8 9 -0.5 0.25 1.5\n3 0 "
      "0 0\n";
  EXPECT_EQ(read_cloud(written("a.ply", ply)).points.at(0), Eigen::Vector3f(-0.5f, 0.25f, 1.5f));
}

TEST_F(CloudFiles, ACloudBehindTheCameraIsTurnedToLookAhead) {
  const std::string head =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n";
  EXPECT_EQ(read_cloud(written("a.pcd", head + "0.1 0.2 -1\nnan nan nan\n")).points[0],
            Eigen::Vector3f(0.1f, -0.2f, 1.0f));
  EXPECT_EQ(read_cloud(written("b.pcd", head + "0.1 0.2 -1\n0.1 0.2 1\n")).points[0],
            Eigen::Vector3f(0.1f, 0.2f, -1.0f));
}

TEST_F(CloudFiles, WhatIsNoCloudSaysSo) {
  EXPECT_EQ(error_of(""), "is empty, expected a PCD or PLY cloud");
  EXPECT_EQ(error_of("hello\n"), "is neither PCD nor PLY");
  EXPECT_THROW(read_cloud(folder / "missing.pcd"), Error);
  EXPECT_THROW(read_cloud(folder), Error);
}

TEST_F(CloudFiles, PcdHeadersAreChecked) {
  const auto pcd = [](const std::string& fields, const std::string& size, const std::string& type,
                      const std::string& width, const std::string& points, const std::string& data) {
    return fmt::format(
        "# .PCD v0.7\nVERSION 0.7\nFIELDS {}\nSIZE {}\nTYPE {}\nCOUNT 1 1 1\nWIDTH {}\nHEIGHT 1\nPOINTS {}\nDATA {}\n",
        fields, size, type, width, points, data);
  };
  const std::string row = "1 2 3\n";
  EXPECT_EQ(error_of(pcd("x y z", "4 4 4", "F F F", "1", "1", "ascii") + row), "");
  EXPECT_EQ(error_of(pcd("x y w", "4 4 4", "F F F", "1", "1", "ascii") + row),
            "header: has no field 'z'; a cloud needs x, y and z");
  EXPECT_EQ(error_of(pcd("x y z", "4 4 5", "F F F", "1", "1", "ascii") + row),
            "header: has an unknown type F5 for 'z'");
  EXPECT_EQ(error_of(pcd("x y z", "4 4", "F F F", "1", "1", "ascii") + row),
            "header: must have as many values of SIZE, TYPE and COUNT as FIELDS");
  EXPECT_EQ(error_of(pcd("x y z", "4 4 4", "F F F", "-1", "1", "ascii") + row),
            "WIDTH: must be a whole number up to 200000000, got '-1'");
  EXPECT_EQ(error_of(pcd("x y z", "4 4 4", "F F F", "2", "1", "ascii") + row), "header: says 2 x 1 but 1 points");
  EXPECT_EQ(error_of(pcd("x y z", "4 4 4", "F F F", "1", "1", "zip") + row),
            "DATA: must be ascii, binary or binary_compressed, got 'zip'");
  EXPECT_EQ(error_of(pcd("x y z", "4 4 4", "F F F", "9", "9", "ascii") + row),
            "is truncated: the header promises at least 54 bytes of points, the file has 7");
  EXPECT_EQ(error_of(pcd("x y z", "4 4 4", "F F F", "2", "2", "binary") + std::string(23, 'a')),
            "is truncated: the header promises at least 24 bytes of points, the file has 23");
  EXPECT_EQ(error_of("# .PCD v0.7\nBERSION 0.7\nFIELDS x y z\n"), "header: has an unknown or a second line 'BERSION'");
  EXPECT_EQ(error_of("# .PCD v0.7\nFIELDS x y z\n"), "header: ends before its line DATA");
}

TEST_F(CloudFiles, PlyHeadersAreChecked) {
  const auto ply = [](const std::string& format, const std::string& vertices, const std::string& z) {
    return fmt::format(
        "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty {}\nend_header\n", format,
        vertices, z);
  };
  EXPECT_EQ(error_of(ply("ascii", "1", "float z") + "1 2 3\n"), "");
  EXPECT_EQ(error_of(ply("ascii", "1", "float w") + "1 2 3\n"), "header: has no field 'z'; a cloud needs x, y and z");
  EXPECT_EQ(error_of(ply("ascii", "1", "real z") + "1 2 3\n"), "header: has an unknown type 'real' for 'z'");
  EXPECT_EQ(error_of(ply("ascii", "many", "float z") + "1 2 3\n"),
            "element vertex: must be a whole number up to 200000000, got 'many'");
  EXPECT_EQ(error_of(ply("text", "1", "float z") + "1 2 3\n"),
            "format: must be ascii, binary_little_endian or binary_big_endian, got 'text'");
  EXPECT_EQ(error_of(ply("binary_little_endian", "2", "float z") + std::string(23, 'a')),
            "is truncated: the header promises at least 24 bytes of points, the file has 23");
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\n"), "header: ends before its line end_header");
}

TEST_F(CloudFiles, WordsWhereNumbersBelongNameTheirLine) {
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n";
  EXPECT_EQ(error_of(pcd + "1 2 3\n\n+4 -nan 6e0\n"), "");
  EXPECT_EQ(error_of(pcd + "1 2 3\n4 five 6\n"), "line 11: must hold numbers, got 'five'");
  EXPECT_EQ(error_of(pcd + "1 2 3\n4 5,0 6\n"), "line 11: must hold numbers, got '5,0'");
  EXPECT_EQ(error_of(pcd + "1.00 2.00 3.00\n4 5\n"), "line 11: must hold more than 2 numbers");
  EXPECT_EQ(error_of(pcd + "1.000000 2.000000 3.000000\n"),
            "is truncated: it ends after line 10, before the last point that the header promises");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement camera 1\nproperty float focal\nelement vertex 1\nproperty float x\nproperty "
      "float "
      "y\nproperty float z\nend_header\n";
  EXPECT_EQ(error_of(ply + "525\n1 2 3\n"), "");
  EXPECT_EQ(error_of(ply + "525\n1 2 three\n"), "line 11: must hold numbers, got 'three'");
}

/// The bytes of numbers, in this machine's order or turned round.
template <class... Numbers>
std::string raw(bool turned, Numbers... numbers) {
  std::string all;
  const auto put = [&](auto number) {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    if (turned) std::reverse(bytes.begin(), bytes.end());
    all += bytes;
  };
  (put(numbers), ...);
  return all;
}

using Byte = std::uint8_t;

/// Colours in any order, lists among the vertices and elements before them are all right.
TEST_F(CloudFiles, PlyIsReadInAnyOrderOfWhatItHolds) {
  const auto header = [](const std::string& format, const std::string& vertex) {
    return "ply\nformat " + format +
           " 1.0\ncomment made by hand\nelement face 2\nproperty list uchar int "
           "vertex_indices\nproperty short flag\nelement vertex 2\n" +
           vertex + "end_header\n";
  };
  const std::string colours =
      "property uchar blue\nproperty float z\nproperty uchar red\nproperty double x\nproperty uchar alpha\nproperty "
      "short y\nproperty list uint float weights\nproperty uchar intensity\n";
  const auto expect_points = [&](const std::string& text) {
    const Cloud cloud = read_cloud(written("a.ply", text));
    ASSERT_EQ(cloud.points.size(), 2u);
    EXPECT_EQ(cloud.points[0], Eigen::Vector3f(0.5f, -2.0f, 1.5f));
    EXPECT_EQ(cloud.points[1], Eigen::Vector3f(0.25f, 3.0f, 2.5f));
    EXPECT_EQ(cloud.intensity, (std::vector<float>{7.0f, 200.0f}));
    EXPECT_EQ(cloud.width, 2);
    EXPECT_EQ(cloud.height, 1);
  };
  expect_points(header("ascii", colours) +
                "3 0 1 0 5\n0 6\n1 1.5 2 0.5 255 -2 2 0.1 0.9 7\n\n1 2.5 2 0.25 255 3 0 200\n");
  for (const bool turned : {false, true}) {
    const std::string faces = raw(turned, Byte{3}, 0, 1, 0, std::int16_t{5}) + raw(turned, Byte{0}, std::int16_t{6});
    expect_points(header(turned ? "binary_big_endian" : "binary_little_endian", colours) + faces +
                  raw(turned, Byte{1}, 1.5f, Byte{2}, 0.5, Byte{255}, std::int16_t{-2}, 2u, 0.1f, 0.9f, Byte{7}) +
                  raw(turned, Byte{1}, 2.5f, Byte{2}, 0.25, Byte{255}, std::int16_t{3}, 0u, Byte{200}));
  }
}

TEST_F(CloudFiles, PlySaysItsGridByACameraOrByItsInfo) {
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::string vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string points = "1 2 3\n1 2 3\n1 2 3\n1 2 3\n";
  const auto size_of = [&](const std::string& text) {
    const Cloud cloud = read_cloud(written("a.ply", text));
    return std::pair(cloud.width, cloud.height);
  };
  EXPECT_EQ(size_of(start + "obj_info num_cols 2\nobj_info num_rows 2\n" + vertices + "end_header\n" + points),
            std::pair(2, 2));
  EXPECT_EQ(size_of(start + "obj_info num_cols 3\nobj_info num_rows 2\n" + vertices + "end_header\n" + points),
            std::pair(4, 1));
  EXPECT_EQ(
      size_of(start + vertices + "element camera 1\nproperty int viewportx\nproperty int viewporty\nend_header\n" +
              points + "2 2\n"),
      std::pair(2, 2));
}

TEST_F(CloudFiles, APlyGridHasPlacesWithoutAPoint) {
  const std::string text =
      "ply\nformat ascii 1.0\nobj_info num_cols 3\nobj_info num_rows 1\nelement vertex 2\nproperty float x\nproperty "
      "float y\nproperty float z\nelement range_grid 3\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n4 5 "
      "6\n";
  const Cloud cloud = read_cloud(written("a.ply", text + "1 1\n0\n1 0\n"));
  EXPECT_EQ(cloud.width, 3);
  EXPECT_EQ(cloud.points.at(0), Eigen::Vector3f(4.0f, 5.0f, 6.0f));
  EXPECT_TRUE(cloud.points.at(1).array().isNaN().all());
  EXPECT_EQ(cloud.points.at(2), Eigen::Vector3f(1.0f, 2.0f, 3.0f));
  for (const char* vertex : {"2", "-1", "nan"})
    EXPECT_EQ(error_of(text + fmt::format("1 {}\n0\n1 0\n", vertex)),
              fmt::format("has the vertex {} in its range_grid, but only 2 vertices", vertex));
}

TEST_F(CloudFiles, PlyListsThatEndTooEarlyAreNamed) {
  const std::string lists =
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty list int uchar tags\n"
      "end_header\n";
  const std::string text = "ply\nformat ascii 1.0\n" + lists;
  EXPECT_EQ(error_of(text + "1 2 3 2 8 9\n"), "");
  EXPECT_EQ(error_of(text + "1 2 3 3 8 9\n"), "line 9: must hold more than 6 numbers");
  EXPECT_EQ(error_of(text + "1 2 3 -1\n"), "has a list 'tags' of -1 values");
  EXPECT_EQ(error_of(text + "1 2 3 nan\n"), "has a list 'tags' of nan values");
  const std::string binary = "ply\nformat binary_little_endian 1.0\n" + lists;
  EXPECT_EQ(error_of(binary + raw(false, 1.0f, 2.0f, 3.0f, 1, Byte{1})), "");
  for (const int length : {2, 2147483647, -1})
    EXPECT_NE(error_of(binary + raw(false, 1.0f, 2.0f, 3.0f, length, Byte{1})), "") << length;
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n"),
            "header: has a list 'x' whose length is no whole number");
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\nproperty float x\nend_header\n"),
            "header: has a property before the first element");
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar float x\nproperty float y\n"
                     "property float z\nend_header\n1 1 2 3\n"),
            "header: has no field 'x'; a cloud needs x, y and z");
}

/// Of what a few bytes promise no memory is claimed.
TEST_F(CloudFiles, PackedPointsThatCannotBeAreRefused) {
  const auto packed = [](std::uint64_t points, std::uint32_t there) {
    return fmt::format(
               "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {}\nHEIGHT 1\nPOINTS {}\nDATA "
               "binary_compressed\n",
               points, points) +
           raw(false, there, static_cast<std::uint32_t>(12 * points)) + std::string(there, '\0');
  };
  EXPECT_EQ(error_of(packed(190'000'000, 100)),
            "header: promises 5.32 GB of points, at most 1 GB is read; raise it with --max-input-mb");
  EXPECT_EQ(error_of(packed(30'000'000, 100)), "is damaged: 360000000 bytes cannot be packed in 100");
  const InputPolicyScope scope({.most_bytes = 6'000'000'000});
  EXPECT_EQ(error_of(packed(190'000'000, 100)), "is damaged: 2280000000 bytes cannot be packed in 100");
}

/// What there is at once counts: the file, what is unpacked of it, and the cloud.
TEST_F(CloudFiles, TheFileAndWhatIsMadeOfItCountAsMemory) {
  constexpr int kPoints = 40'000;
  const InputPolicyScope policy({.most_bytes = 1'000'000});
  const std::string points(12 * kPoints, '\0');
  const auto pcd = [](int count, const char* encoding) {
    return fmt::format(
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {}\nHEIGHT 1\nPOINTS {}\nDATA {}\n",
        count, count, encoding);
  };
  EXPECT_EQ(error_of(pcd(kPoints, "binary") + points),
            "header: promises 1.12 MB of points, at most 1 MB is read; raise it with --max-input-mb");
  constexpr int kLines = 50'000;
  std::string text;
  for (int i = 0; i < kLines; ++i) text += "1 1 1\n";
  EXPECT_EQ(error_of(pcd(kLines, "ascii") + text),
            "header: promises 1.1 MB of points, at most 1 MB is read; raise it with --max-input-mb");
  const std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\n";
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(ply), kPoints) + "end_header\n" + points),
            "header: promises 1.12 MB of points, at most 1 MB is read; raise it with --max-input-mb");
  EXPECT_EQ(
      error_of(fmt::format(fmt::runtime(ply), 1) +
               fmt::format("element range_grid {}\nproperty list uchar int vertex_indices\nend_header\n", kPoints) +
               std::string(12 + kPoints, '\0')),
      "header: promises 1.32 MB of points, at most 1 MB is read; raise it with --max-input-mb");
}

TEST_F(CloudFiles, AHeaderHasNoMoreLinesThanOneNeeds) {
  std::string comments;
  for (int i = 0; i < 10'000; ++i) comments += "#\n";
  EXPECT_EQ(error_of(comments + "VERSION 0.7\nFIELDS x y z\n"), "header: has more than 10000 lines");
  comments.clear();
  for (int i = 0; i < 10'000; ++i) comments += "comment\n";
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\n" + comments), "header: has more than 10000 lines");
}

/// Files cut off anywhere and files with flipped bytes: an Error or a cloud, nothing else.
TEST_F(CloudFiles, DamageNeverCrashes) {
  pcl::PointCloud<pcl::PointXYZI> cloud(20, 10);
  Rng rng(3);
  for (auto& point : cloud) point.getVector3fMap() = Eigen::Vector3f::Constant(static_cast<float>(1.0 + rng.uniform()));
  pcl::PCDWriter().writeASCII((folder / "0").string(), cloud);
  pcl::PCDWriter().writeBinary((folder / "1").string(), cloud);
  pcl::PCDWriter().writeBinaryCompressed((folder / "2").string(), cloud);
  pcl::PLYWriter().write((folder / "3").string(), cloud, false, true);
  pcl::PLYWriter().write((folder / "4").string(), cloud, true, true);
  for (int kind = 0; kind < 5; ++kind) {
    const std::string whole = read_text(folder / std::to_string(kind));
    for (int trial = 0; trial < 60; ++trial) {
      std::string damaged = whole;
      if (trial % 2 == 0)
        damaged.resize(rng.below(static_cast<std::uint32_t>(whole.size())));
      else
        damaged[rng.below(static_cast<std::uint32_t>(std::min<std::size_t>(whole.size(), 600)))] ^=
            static_cast<char>(1 + rng.below(255));
      error_of(damaged);
    }
  }
}

}  // namespace
}  // namespace fathom
