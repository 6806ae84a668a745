// Cups as meshes: closed, outside out, and as large as the body of revolution they stand for.
#include "sim/scene/cup_mesh.h"
#include "core/json.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <numbers>

namespace fathom {
namespace {

CupShape library_cup(const std::string& name) {
  const Json json = name;
  return cup_shape_from_json(JsonReader(json, "test"));
}

double signed_volume(const Mesh& mesh) {
  double six_volumes = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles)
    six_volumes += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six_volumes / 6.0;
}

/// Volume under a profile of straight lines: a sum of frustums.
double volume_of_revolution(const std::vector<Eigen::Vector2d>& profile) {
  double volume = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double a = profile[i - 1].x(), b = profile[i].x();
    volume += std::numbers::pi / 3.0 * (profile[i].y() - profile[i - 1].y()) * (a * a + a * b + b * b);
  }
  return volume;
}

/// A regular polygon's area over its circumscribed circle's: what faceting takes from every level section.
double facet_factor() {
  const double angle = 2.0 * std::numbers::pi / kFacetsAround;
  return std::sin(angle) / angle;
}

TEST(CupMesh, IsClosed) {
  for (const char* name : {"paper_cup", "tapered_cup"}) {
    const Mesh mesh = cup_mesh(library_cup(name));
    const auto place = [&](int vertex) {
      const Eigen::Vector3d& v = mesh.vertices[vertex];
      return std::array{v.x() + 0.0, v.y() + 0.0, v.z()};  // −0 becomes 0
    };
    std::map<std::array<std::array<double, 3>, 2>, int> edges;
    for (const Eigen::Vector3i& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) ++edges[{place(t[i]), place(t[(i + 1) % 3])}];
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1) << name;
      ASSERT_EQ(edges.count({edge[1], edge[0]}), 1u) << name;
    }
  }
}

TEST(CupMesh, HasTheVolumeOfItsWallsAndBottomTurnedOutward) {
  for (const char* name : {"paper_cup", "tapered_cup"}) {
    const CupShape shape = library_cup(name);
    const double expected = (volume_of_revolution(shape.outer) - volume_of_revolution(shape.inner)) * facet_factor();
    EXPECT_NEAR(signed_volume(cup_mesh(shape)) / expected, 1.0, 1e-12) << name;  // roundings of 2000 triangles
  }
  EXPECT_LT(1.0 - facet_factor(), 1.1e-4);  // the faceting error itself
}

TEST(CupMesh, AHandleReachesAsFarAsItSays) {
  const CupShape mug = library_cup("mug");
  double farthest = 0.0, lowest = 1.0;
  for (const Eigen::Vector3d& vertex : cup_mesh(mug).vertices) {
    farthest = std::max(farthest, vertex.x());
    lowest = std::min(lowest, vertex.z());
  }
  EXPECT_NEAR(farthest, 0.037 + 0.030 + 0.005, 1e-12);  // the wall's middle, the reach, the tube
  EXPECT_EQ(lowest, 0.0);
}

TEST(CupMesh, TheLiquidIsLevelAndReachesIntoTheWall) {
  const Mesh disc = liquid_disc(library_cup("paper_cup"), 0.037);
  double widest = 0.0;
  for (const Eigen::Vector3d& vertex : disc.vertices) {
    EXPECT_EQ(vertex.z(), 0.037);
    widest = std::max(widest, vertex.head<2>().norm());
  }
  EXPECT_NEAR(widest, 0.0415, 1e-15);  // inner radius 40, outer 43
  const Eigen::Vector3i& t = disc.triangles.front();
  const Eigen::Vector3d& a = disc.vertices[t[0]];
  EXPECT_GT((disc.vertices[t[1]] - a).cross(disc.vertices[t[2]] - a).z(), 0.0);  // faces up
}

TEST(CupShape, InnerRadiusIsInterpolatedAlongTheProfile) {
  const CupShape tapered = library_cup("tapered_cup");
  EXPECT_NEAR(tapered.inner_radius(0.004), 0.026, 1e-15);
  EXPECT_NEAR(tapered.inner_radius(0.047), 0.032, 1e-15);  // half-way
  EXPECT_NEAR(tapered.inner_radius(0.090), 0.038, 1e-15);
  EXPECT_NEAR(tapered.inner_radius(0.120), 0.038, 1e-15);
  EXPECT_EQ(library_cup("paper_cup").inner_radius(0.050), 0.040);
}

}  // namespace
}  // namespace fathom
