// The parts of a clear wall that a liquid touches, against closed forms.
#include "sim/scene/wetted_wall.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "sim/scene/mesh_topology.h"
#include "tests/scene/vessels.h"

namespace fathom {
namespace wetted_wall_test {

constexpr double kRadius = 0.040, kOuter = 0.043, kFloor = 0.007, kRim = 0.087;

double area(const GltfPart& part) {
  double sum = 0.0;
  for (const Eigen::Vector3i& t : part.mesh.triangles) {
    const Eigen::Vector3d& a = part.mesh.vertices[t[0]];
    sum += 0.5 * (part.mesh.vertices[t[1]] - a).cross(part.mesh.vertices[t[2]] - a).norm();
  }
  return sum;
}

/// Areas of a disc and of an upright wall that are regular polygons with their corners on the circle.
double disc(double radius) { return std::numbers::pi * radius * radius * vessel_facet_factor(); }
double wall(double radius, double height) {
  return 2.0 * kVesselFacets * radius * std::sin(std::numbers::pi / kVesselFacets) * height;
}

/// A closed wall of revolution: the profile runs from the underside's centre over the rim to the floor's centre.
GltfPart closed_wall(const std::vector<Eigen::Vector2d>& profile) {
  GltfPart part;
  part.mesh = sheet_of_revolution(profile);
  part.medium = Medium{};
  return part;
}

GltfPart tumbler() {
  return closed_wall({{0.0, 0.0}, {kOuter, 0.0}, {kOuter, kRim}, {kRadius, kRim}, {kRadius, kFloor}, {0.0, kFloor}});
}

Cavity cavity_of(const GltfPart& part) { return *find_cavity(std::span(&part.mesh, 1)); }

constexpr double kRounding = 1e-12;  // of areas, over some thousand triangles

TEST(WettedWall, IsTheFloorAndTheInnerWallUpToTheLevel) {
  const GltfPart part = tumbler();
  ASSERT_TRUE(encloses_volume(part.mesh));
  const Cavity cavity = cavity_of(part);
  for (const double depth : {0.0001, 0.030, 0.07999}) {
    const WettedWall cut = cut_at_liquid(part, cavity, kFloor + depth);
    EXPECT_NEAR(area(cut.wetted) / (disc(kRadius) + wall(kRadius, depth)), 1.0, kRounding) << depth;
    EXPECT_NEAR((area(cut.wetted) + area(cut.dry)) / area(part), 1.0, kRounding) << depth;
    for (const Eigen::Vector3d& vertex : cut.wetted.mesh.vertices) {
      EXPECT_LE(vertex.z(), kFloor + depth);
      EXPECT_LT(vertex.head<2>().norm(), kRadius + kRounding);
    }
  }
}

TEST(WettedWall, CloseTogetherAgain) {
  const GltfPart part = tumbler();
  WettedWall cut = cut_at_liquid(part, cavity_of(part), 0.0371);
  cut.dry.mesh.append(cut.wetted.mesh);
  EXPECT_TRUE(encloses_volume(cut.dry.mesh));
}

TEST(WettedWall, HoldsWhereTheWallIsTurnedAndAskedAtALevelOfItsVertices) {
  GltfPart part = tumbler();
  // A ring of vertices at 30 mm, and a quarter turn about a leaning axis.
  part = closed_wall({{0.0, 0.0},
                      {kOuter, 0.0},
                      {kOuter, 0.037},
                      {kOuter, kRim},
                      {kRadius, kRim},
                      {kRadius, 0.037},
                      {kRadius, kFloor},
                      {0.0, kFloor}});
  const WettedWall upright = cut_at_liquid(part, cavity_of(part), 0.037);
  EXPECT_NEAR(area(upright.wetted) / (disc(kRadius) + wall(kRadius, 0.030)), 1.0, kRounding);
  part.transform(Pose(Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.6, 0.8, 0.0))));
  const Cavity cavity = cavity_of(part);
  const WettedWall leaning = cut_at_liquid(part, cavity, cavity.floor() + 0.040);
  // A leaning cylinder is wetted as high on the average as at its axis: Pappus.
  const double on_axis = (cavity.floor() + 0.040 - (std::cos(0.2) * kFloor)) / std::cos(0.2);
  EXPECT_NEAR(area(leaning.wetted) / (disc(kRadius) + wall(kRadius, on_axis)), 1.0, kRounding);
}

TEST(WettedWall, APocketBehindAnInnerRimIsDryUntilTheLevelPassesIt) {
  // A well of 10 mm in the middle, a dam of 12 mm around it, a ring-shaped pocket of 5 mm beyond.
  const GltfPart part = closed_wall({{0.0, 0.0},
                                     {kOuter, 0.0},
                                     {kOuter, kRim},
                                     {kRadius, kRim},
                                     {kRadius, 0.015},
                                     {0.025, 0.015},
                                     {0.025, 0.022},
                                     {0.020, 0.022},
                                     {0.020, 0.010},
                                     {0.0, 0.010}});
  const Cavity cavity = cavity_of(part);
  const double well = disc(0.020) + wall(0.020, 0.010);
  EXPECT_NEAR(area(cut_at_liquid(part, cavity, 0.020).wetted) / well, 1.0, kRounding);
  const double all = disc(kRadius) + wall(0.020, 0.012) + wall(0.025, 0.007) + wall(kRadius, 0.015);
  EXPECT_NEAR(area(cut_at_liquid(part, cavity, 0.030).wetted) / all, 1.0, kRounding);
}

TEST(WettedWall, OfADoubleWalledGlassIsTheInnerGlassOnly) {
  GltfPart part =
      closed_wall({{0.0, 0.0}, {0.050, 0.0}, {0.050, kRim}, {kRadius, kRim}, {kRadius, 0.014}, {0.0, 0.014}});
  // The vacuum between the two glasses, 0.2 mm wide: less than a voxel. Its boundary faces out of the glass, into it.
  const GltfPart gap =
      closed_wall({{0.0, 0.0125}, {0.0415, 0.0125}, {0.0415, 0.080}, {0.0417, 0.080}, {0.0417, 0.0123}, {0.0, 0.0123}});
  part.mesh.append(gap.mesh);
  ASSERT_TRUE(encloses_volume(part.mesh));
  const WettedWall cut = cut_at_liquid(part, cavity_of(part), 0.050);
  EXPECT_NEAR(area(cut.wetted) / (disc(kRadius) + wall(kRadius, 0.036)), 1.0, kRounding);
}

TEST(MeshTopology, OnlyClosedMeshesThatFaceOutEncloseAVolume) {
  Mesh mesh = tumbler().mesh;
  Mesh inside_out = mesh, open = mesh, one_flipped = mesh;
  for (Eigen::Vector3i& t : inside_out.triangles) std::swap(t[0], t[1]);
  open.triangles.pop_back();
  std::swap(one_flipped.triangles[0][0], one_flipped.triangles[0][1]);
  EXPECT_TRUE(encloses_volume(mesh));
  EXPECT_FALSE(encloses_volume(inside_out));
  EXPECT_FALSE(encloses_volume(open));
  EXPECT_FALSE(encloses_volume(one_flipped));
  EXPECT_FALSE(encloses_volume(Mesh{}));
}

TEST(MeshTopology, PatchesEndWhereThreeTrianglesMeet) {
  Mesh mesh;
  for (const Eigen::Vector3d& v : {Eigen::Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {2, 0, 0}})
    mesh.add_vertex(v);
  mesh.add_triangle(0, 1, 2);
  mesh.add_triangle(2, 1, 3);  // joined to the first by the edge 1–2
  mesh.add_triangle(0, 1, 4);
  mesh.add_triangle(1, 0, 5);  // the third at the edge 0–1
  const std::vector<int> patch = patches(mesh);
  EXPECT_EQ(patch[0], patch[1]);
  EXPECT_NE(patch[0], patch[2]);
  EXPECT_NE(patch[0], patch[3]);
  EXPECT_NE(patch[2], patch[3]);
}

}  // namespace wetted_wall_test
}  // namespace fathom
