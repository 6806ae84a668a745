// A slab of water from a glTF file against the same water poured into the cup.
#include <gtest/gtest.h>

#include "sim/render/truth.h"
#include "tests/core/temporary_folder.h"
#include "tests/render/gltf_slab.h"
#include "tests/render/scenes.h"

namespace fathom {
namespace {

TEST(GltfBody, ASlabOfWaterIsTheWaterInTheCup) {
  const TemporaryFolder folder;
  // From half-way down the cup's bottom to the level, the sides within the wall of 40 to 43 mm.
  const auto file = write_clear_gltf(folder / "", prism(64, 0.042, 0.0035, kPaperCupBottom + 0.030), 1.3281, 0.0031);
  auto with_slab = cup_of(kPaperCup, "");
  with_slab.scene.objects.push_back({file, Pose(Eigen::Translation3d(0.0, 0.300, 0.0))});
  const LitScene poured(cup_of(kPaperCup, kWater)), slab(with_slab);
  EXPECT_FALSE(slab.world.level_liquids_only());
  const Image<TruePixel> expected = trace_truth(poured.projector, poured.rig),
                         found = trace_truth(slab.projector, slab.rig);
  int refracted = 0, lit = 0, differently = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const TruePixel &a = expected.pixels()[i], &b = found.pixels()[i];
    if (a.path != PathKind::refracted || a.position.z() > kPaperCupBottom + 1e-9) continue;
    ++refracted;
    ASSERT_EQ(b.path, PathKind::refracted);
    // The level is a float in the file, 2e-9 m off.
    EXPECT_LT((a.position - b.position).norm(), 1e-6);
    differently += a.apparent_depth.has_value() != b.apparent_depth.has_value();
    if (!a.apparent_depth || !b.apparent_depth) continue;
    ++lit;
    EXPECT_NEAR(*a.apparent_depth, *b.apparent_depth, 1e-6);
    EXPECT_NEAR(a.intensity / b.intensity, 1.0, 1e-6);
  }
  EXPECT_GT(refracted, 1000);
  EXPECT_GT(lit, 1000);
  EXPECT_LE(differently, lit / 1000);  // on the edge of the rim's shadow
}

}  // namespace
}  // namespace fathom
