// Cavities of meshes against closed forms, and against everything that meshes from elsewhere are: open, doubled, turned
// inside out, cracked.
#include "sim/scene/cavity.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "core/units.h"
#include "sim/scene/cup_mesh.h"
#include "tests/scene/vessels.h"

namespace fathom {
namespace cavity_test {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.040, kFloor = 0.007, kRim = 0.087;

std::optional<Cavity> cavity_of(const Mesh& mesh) { return find_cavity(std::span(&mesh, 1)); }

Mesh sheet_cylinder() { return sheet_of_revolution({{0.0, kFloor}, {kRadius, kFloor}, {kRadius, kRim}}); }

/// The paper's cup as a parametric shape: walls of two sheets, 3 mm thick.
CupShape walled_cylinder() {
  CupShape shape;
  shape.inner = {{0.0, kFloor}, {kRadius, kFloor}, {kRadius, kRim}};
  shape.outer = {{0.0, 0.0}, {kRadius + 0.003, 0.0}, {kRadius + 0.003, kRim}};
  return shape;
}

double cylinder_volume(double depth) { return kPi * kRadius * kRadius * depth * vessel_facet_factor(); }

/// Area of a level mesh seen from above.
double area(const Mesh& mesh) {
  double sum = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles)
    sum += 0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).z();
  return sum;
}

/// Triangles for which `keep` (of their centre) says so.
template <class Keep>
Mesh kept(const Mesh& mesh, Keep keep) {
  Mesh result = mesh;
  std::erase_if(result.triangles, [&](const Eigen::Vector3i& t) {
    return !keep(Eigen::Vector3d((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0));
  });
  return result;
}

void expect_cylinder(const Mesh& mesh, double facet_factor, double tolerance, const char* what) {
  const std::optional<Cavity> cavity = cavity_of(mesh);
  ASSERT_TRUE(cavity) << what;
  EXPECT_NEAR(cavity->floor(), kFloor, 1e-9) << what;  // heights are bisected to a nanometre
  EXPECT_NEAR(cavity->rim(), kRim, 2e-9) << what;
  for (const double depth : {0.0003, 0.010, 0.030, 0.0799})
    EXPECT_NEAR(cavity->volume(kFloor + depth) / (kPi * kRadius * kRadius * depth * facet_factor), 1.0, tolerance)
        << what << ", " << depth << " m deep";
}

// Sections are cut at 1e-7 m (see plane_cells.cpp) of a radius of 40 mm.
constexpr double kExact = 1e-5;

TEST(Cavity, ACylinderOfOneSheetHasItsVolume) {
  expect_cylinder(sheet_cylinder(), vessel_facet_factor(), kExact, "one sheet");
}

TEST(Cavity, AWalledCylinderHasItsInnerVolume) {
  const double angle = 2.0 * kPi / kFacetsAround;
  expect_cylinder(cup_mesh(walled_cylinder()), std::sin(angle) / angle, kExact, "two sheets");
}

TEST(Cavity, AConeHasItsVolumeDownToTheTip) {
  const Mesh cone = sheet_of_revolution({{0.0, 0.010}, {0.040, 0.090}});
  const std::optional<Cavity> cavity = cavity_of(cone);
  ASSERT_TRUE(cavity);
  EXPECT_NEAR(cavity->floor(), 0.010, 1e-9);
  EXPECT_NEAR(cavity->rim(), 0.090, 2e-9);
  for (const double depth : {0.010, 0.040, 0.080})
    // What is missing lies below the lowest voxel's centre line, within a voxel of the tip: 0.5³ mm³ of 260 mm³ at
    // least.
    EXPECT_NEAR(cavity->volume(0.010 + depth) / (kPi * depth * depth * depth / 12.0 * vessel_facet_factor()), 1.0, 5e-4)
        << depth;
}

TEST(Cavity, AHemisphereHasItsVolume) {
  std::vector<Eigen::Vector2d> profile;
  constexpr int kRings = 200;
  for (int i = 0; i <= kRings; ++i) {
    const double angle = 0.5 * kPi * i / kRings;
    profile.emplace_back(i == 0 ? 0.0 : kRadius * std::sin(angle), kRadius * (1.0 - std::cos(angle)));
  }
  const std::optional<Cavity> cavity = cavity_of(sheet_of_revolution(profile));
  ASSERT_TRUE(cavity);
  EXPECT_NEAR(cavity->floor(), 0.0, 1e-9);
  EXPECT_NEAR(cavity->rim(), kRadius, 2e-9);
  for (const double depth : {0.010, 0.020, 0.040}) {
    const double cap = kPi * depth * depth * (kRadius - depth / 3.0) * vessel_facet_factor();
    EXPECT_NEAR(cavity->volume(depth) / cap, 1.0, 1e-4) << depth;  // the profile's chords: (90°/200)²/8 = 8e-6, twice
  }
}

TEST(Cavity, AHandlesHoleIsNoCavityAndTheHandleTakesNoVolume) {
  Mesh mug = cup_mesh(walled_cylinder());
  mug.append(torus({0.0685, 0.0, 0.045}, 0.022, 0.005));  // its tube reaches 1.5 mm into the wall of 3 mm
  const double angle = 2.0 * kPi / kFacetsAround;
  expect_cylinder(mug, std::sin(angle) / angle, kExact, "mug");
}

TEST(Cavity, FlippedDoubledAndCrossingTrianglesChangeNothing) {
  Mesh flipped = sheet_cylinder();
  Rng rng(1);
  for (Eigen::Vector3i& t : flipped.triangles)
    if (rng.below(2)) std::swap(t[0], t[1]);
  expect_cylinder(flipped, vessel_facet_factor(), kExact, "flipped");

  Mesh doubled = sheet_cylinder();
  doubled.append(sheet_cylinder());
  expect_cylinder(doubled, vessel_facet_factor(), kExact, "doubled");

  // A tube that goes on below a disc that goes on outside the tube.
  Mesh crossing = sheet_of_revolution({{kRadius, 0.0}, {kRadius, kRim}});
  crossing.append(sheet_of_revolution({{0.0, kFloor}, {kRadius + 0.010, kFloor}}));
  expect_cylinder(crossing, vessel_facet_factor(), kExact, "crossing");
}

TEST(Cavity, CracksNarrowerThanAVoxelHold) {
  // Slits of 0.3 mm: between the bottom and the wall, and down the wall from the rim to the bottom.
  Mesh around = sheet_of_revolution({{kRadius, kFloor}, {kRadius, kRim}});
  around.append(sheet_of_revolution({{0.0, kFloor}, {kRadius - 0.0003, kFloor}}));
  expect_cylinder(around, vessel_facet_factor(), kExact, "slit around the bottom");

  // The facet that closes the wall is taken out, the others are spread until the slit that it leaves is that narrow.
  Mesh along = sheet_cylinder();
  std::erase_if(along.triangles, [](const Eigen::Vector3i& t) {
    const auto of_facet = [&](int facet) {
      return (t.array() - t.array() / kVesselFacets * kVesselFacets == facet).any();
    };
    return of_facet(0) && of_facet(kVesselFacets - 1);
  });
  const double slit = 0.0003 / kRadius, facet = (2.0 * kPi - slit) / (kVesselFacets - 1);
  for (std::size_t i = 0; i < along.vertices.size(); ++i) {
    const double angle = facet * static_cast<double>(i % kVesselFacets);
    along.vertices[i].head<2>() =
        along.vertices[i].head<2>().norm() * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  const double polygon = ((kVesselFacets - 1) * std::sin(facet) + std::sin(slit)) / (2.0 * kPi);
  expect_cylinder(along, polygon, kExact, "slit down the wall");
}

TEST(Cavity, ASlitWiderThanTwoVoxelsEmptiesTheCup) {
  const Mesh slit = kept(sheet_cylinder(), [](const Eigen::Vector3d& c) {  // one facet, 1.96 mm wide
    return c.x() < 0.0 || c.y() < 0.0 || c.y() > 0.0015 || c.z() < kFloor + 1e-9;
  });
  EXPECT_FALSE(cavity_of(slit));
}

TEST(Cavity, WhatIsMissingAboveTheLevelIsTheNewRim) {
  // A window of six facets of 1.96 mm, from 50 mm up.
  std::vector<Eigen::Vector2d> profile{
      {0.0, kFloor}, {kRadius, kFloor}, {kRadius, 0.050}, {kRadius, 0.070}, {kRadius, kRim}};
  const Mesh open = kept(sheet_of_revolution(profile), [](const Eigen::Vector3d& c) {
    return !(c.z() > 0.050 && c.z() < 0.070 && c.x() > 0.0 && std::fabs(c.y()) < 0.0055);
  });
  const std::optional<Cavity> cavity = cavity_of(open);
  ASSERT_TRUE(cavity);
  EXPECT_NEAR(cavity->rim(), 0.050, 2e-9);
  EXPECT_NEAR(cavity->spill().z(), 0.050, 2e-9);
  EXPECT_GT(cavity->spill().x(), 0.039);  // it says where
  EXPECT_LT(std::fabs(cavity->spill().y()), 0.007);
  EXPECT_NEAR(cavity->volume(0.040) / cylinder_volume(0.033), 1.0, kExact);
}

TEST(Cavity, RandomTrianglesMissingNearTheRimLeaveTheVolumeBelow) {
  std::vector<Eigen::Vector2d> profile{{0.0, kFloor}};
  for (int i = 0; i <= 20; ++i) profile.emplace_back(kRadius, kFloor + 0.004 * i);
  Rng rng(7);
  const Mesh ragged = kept(sheet_of_revolution(profile),
                           [&](const Eigen::Vector3d& c) { return c.z() < 0.055 || rng.uniform() > 0.2; });
  const std::optional<Cavity> cavity = cavity_of(ragged);
  ASSERT_TRUE(cavity);
  EXPECT_GE(cavity->rim(), 0.055 - 1e-9);
  EXPECT_LE(cavity->rim(), 0.060);
  for (const double depth : {0.010, 0.040})
    EXPECT_NEAR(cavity->volume(kFloor + depth) / cylinder_volume(depth), 1.0, kExact) << depth;
}

TEST(Cavity, ATiltedCupSpillsAtItsLowestLip) {
  Mesh mesh = sheet_cylinder();
  const double tilt = radians_from_deg(20.0);
  mesh.transform(Pose(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY())));  // leans towards +x
  const std::optional<Cavity> cavity = cavity_of(mesh);
  ASSERT_TRUE(cavity);
  const double s = std::sin(tilt), c = std::cos(tilt);
  EXPECT_NEAR(cavity->floor(), kFloor * c - kRadius * s, 1e-9);
  // Near the lip's lowest point an opening of w = 1 mm, the tolerance, is w²/(8 r) sin(tilt) high: 1 µm; of 128 corners
  // one stands within 1.4° of that point.
  EXPECT_NEAR(cavity->rim(), kRim * c - kRadius * s, 1.2e-5);
  EXPECT_GT(cavity->spill().x(), 0.060);
  EXPECT_LT(std::fabs(cavity->spill().y()), 0.002);
  // A level that covers the whole bottom cuts the cylinder obliquely: the volume is that under the axis.
  const double along_axis = 0.035, level = (kFloor + along_axis) * c;
  EXPECT_NEAR(cavity->volume(level) / cylinder_volume(along_axis), 1.0, 1e-4);
}

TEST(Cavity, OfABowlInABowlTheOuterHoldsUntilTheInnerRimFloods) {
  Mesh bowls = sheet_of_revolution({{0.0, 0.0}, {0.060, 0.0}, {0.060, 0.050}});
  bowls.append(sheet_of_revolution({{0.0, 0.004}, {0.030, 0.004}, {0.030, 0.020}}));
  // The lower bowl is open below the inner one's bottom: liquid runs under it.
  const std::optional<Cavity> cavity = cavity_of(bowls);
  ASSERT_TRUE(cavity);
  const double ring = kPi * (0.060 * 0.060 - 0.030 * 0.030) * vessel_facet_factor();
  const double whole = kPi * 0.060 * 0.060 * vessel_facet_factor();
  EXPECT_NEAR(cavity->floor(), 0.0, 1e-9);
  EXPECT_NEAR(cavity->rim(), 0.050, 2e-9);
  EXPECT_NEAR(cavity->volume(0.015) / (0.004 * whole + 0.011 * ring), 1.0, 1e-3);  // the slice through the inner bottom
  EXPECT_NEAR(cavity->volume(0.030) / (0.030 * whole), 1.0, 1e-3);
  EXPECT_NEAR(area(cavity->surface(0.015)) / ring, 1.0, 1e-3);
  EXPECT_NEAR(area(cavity->surface(0.030)) / whole, 1.0, 1e-3);
}

TEST(Cavity, WhatHoldsNothingIsNoCavity) {
  const Mesh plate = sheet_of_revolution({{0.0, 0.0}, {0.080, 0.0}, {0.080, 0.003}, {0.0, 0.003}});
  Mesh inverted = cup_mesh(walled_cylinder());
  for (Eigen::Vector3d& v : inverted.vertices) v.z() = kRim - v.z();
  const Mesh closed = sheet_of_revolution({{0.0, 0.0}, {kRadius, 0.0}, {kRadius, kRim}, {0.0, kRim}});
  const Mesh tube = sheet_of_revolution({{kRadius, 0.0}, {kRadius, kRim}});
  EXPECT_FALSE(cavity_of(plate));
  EXPECT_FALSE(cavity_of(inverted));
  EXPECT_FALSE(cavity_of(closed));
  EXPECT_FALSE(cavity_of(tube));
  EXPECT_FALSE(cavity_of(Mesh{}));
  EXPECT_FALSE(find_cavity({}));
  Mesh point;
  for (int i = 0; i < 3; ++i) point.add_vertex({0.1, 0.2, 0.3});
  point.add_triangle(0, 1, 2);
  EXPECT_FALSE(cavity_of(point));
}

// Without a limit the grid of the plate would have 10^10 voxels, and that of the pole more layers than can be numbered.
TEST(Cavity, ThinBodiesOfAnySizeAreMeasured) {
  Mesh flat;
  for (const Eigen::Vector3d& v : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(20, 0, 0), Eigen::Vector3d(0, 20, 0)})
    flat.add_vertex(v);
  flat.add_triangle(0, 1, 2);
  EXPECT_FALSE(cavity_of(flat));

  Mesh on_pole = sheet_cylinder();
  const int foot = on_pole.add_vertex({0.041, 0.0, 0.01});
  on_pole.add_vertex({0.041, 0.0, 20.0});
  on_pole.add_vertex({0.042, 0.0, 20.0});
  on_pole.add_triangle(foot, foot + 1, foot + 2);
  const std::optional<Cavity> cavity = cavity_of(on_pole);
  ASSERT_TRUE(cavity);
  // Within the voxels, here of about 2 mm, the columns decide; the walls themselves are cut exactly.
  EXPECT_NEAR(cavity->volume(0.037) / cylinder_volume(0.030), 1.0, 1e-5);
}

TEST(Cavity, LevelAndVolumeAreInverse) {
  const std::optional<Cavity> cavity = cavity_of(sheet_of_revolution({{0.0, 0.005}, {0.025, 0.005}, {0.040, 0.090}}));
  ASSERT_TRUE(cavity);
  for (const double level : {0.0055, 0.020, 0.0601, 0.0899})
    EXPECT_NEAR(cavity->level_of(cavity->volume(level)), level, 2e-9) << level;
  EXPECT_NEAR(cavity->level_of(cavity->capacity()), cavity->rim(), 2e-9);
}

TEST(Cavity, TheSurfaceIsLevelFacesUpAndReachesIntoTheWall) {
  for (const bool walled : {false, true}) {
    const std::optional<Cavity> cavity = cavity_of(walled ? cup_mesh(walled_cylinder()) : sheet_cylinder());
    ASSERT_TRUE(cavity);
    const Mesh surface = cavity->surface(0.037);
    // 0.25 mm into walls of two sheets, 2 µm beyond single ones.
    const double radius = kRadius + (walled ? 0.25e-3 : 2e-6);
    double widest = 0.0;
    for (const Eigen::Vector3d& v : surface.vertices) {
      EXPECT_EQ(v.z(), 0.037);
      widest = std::max(widest, v.head<2>().norm());
    }
    EXPECT_NEAR(widest, radius, 1e-6);
    for (const Eigen::Vector3i& t : surface.triangles)
      EXPECT_GE(
          (surface.vertices[t[1]] - surface.vertices[t[0]]).cross(surface.vertices[t[2]] - surface.vertices[t[0]]).z(),
          -1e-12);                                                    // slivers at the edge
    EXPECT_NEAR(area(surface) / (kPi * radius * radius), 1.0, 1e-3);  // of a polygon: 4e-4
  }
}

TEST(Cavity, SmallCupsAreMeasuredAsWellAsLargeOnes) {
  for (const double scale : {0.1, 4.0}) {
    Mesh mesh = cup_mesh(walled_cylinder());
    for (Eigen::Vector3d& v : mesh.vertices) v *= scale;
    const std::optional<Cavity> cavity = cavity_of(mesh);
    ASSERT_TRUE(cavity) << scale;
    const double angle = 2.0 * kPi / kFacetsAround;
    EXPECT_NEAR(cavity->capacity() / (kPi * kRadius * kRadius * 0.080 * std::pow(scale, 3) * std::sin(angle) / angle),
                1.0, 1e-4)
        << scale;
  }
}

}  // namespace cavity_test
}  // namespace fathom
