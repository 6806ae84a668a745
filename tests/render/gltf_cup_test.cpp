// A cup is the same cup whether it is described by its profile or by its triangles in a glTF file.
#include <gtest/gtest.h>

#include "sim/render/truth.h"
#include "sim/scene/cup_mesh.h"
#include "tests/core/temporary_folder.h"
#include "tests/render/scenes.h"
#include "tests/scene/write_gltf.h"

namespace fathom {
namespace {

Image<TruePixel> truth_of(const Setup& setup) {
  const Geometry geometry = build_geometry(setup.scene, setup.rig.sensor.wavelength_nm);
  const Intersector world(geometry);
  return trace_truth(PointLight(world, setup.rig.projector_in_world()), setup.rig);
}

TEST(GltfCup, HasTheDepthsOfItsParametricTwin) {
  const TemporaryFolder folder;
  const auto parametric = cup_setup(30.0, 300.0, 300.0);
  write_gltf(folder / "cup.gltf", cup_mesh(std::get<CupShape>(parametric.scene.cups[0].shape)));
  Json scene = parametric.source;
  scene["cups"][0]["shape"] = "cup.gltf";
  const Image<TruePixel> a = truth_of(parametric);
  const Image<TruePixel> b = truth_of(setup_from_json(scene, (folder / "scene.json").string()));
  int bottom = 0, differing = 0;
  double worst_bottom = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const TruePixel &p = a.pixels()[i], &q = b.pixels()[i];
    // At the outlines a rounding decides what is seen; elsewhere coordinates of 0.1 m are floats in the file (4e-9 m).
    const bool same = p.path == q.path && p.object == q.object &&
                      p.apparent_depth.has_value() == q.apparent_depth.has_value() &&
                      (p.position - q.position).norm() < 1e-6;
    differing += !same;
    if (!same || !p.apparent_depth) continue;
    const double difference = std::fabs(*p.apparent_depth - *q.apparent_depth);
    worst = std::max(worst, difference);
    if (p.path != PathKind::refracted || p.position.z() > kPaperCupBottom + 1e-6) continue;
    worst_bottom = std::max(worst_bottom, difference);
    ++bottom;
  }
  EXPECT_GT(bottom, 500);
  EXPECT_LE(differing, 20);       // of 307 200 pixels
  EXPECT_LT(worst_bottom, 4e-8);  // 4e-9 m of floor or level, times the triangulation's Z / b = 9
  EXPECT_LT(worst, 1e-6);         // and times up to 30 where a ray grazes a wall
}

}  // namespace
}  // namespace fathom
