// A laboratory's own cup as the model has it: its walls lean, and all that looks at them knows.
#include <gtest/gtest.h>

#include <cmath>

#include "core/library.h"
#include "diagnosis/predict/surrogate.h"
#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {
namespace {

LaboratoryRig laboratory_with(const CupProfile& cup, const std::string& name) {
  LaboratoryRig rig = paper_laboratory();
  rig.cup_shape = name;
  rig.cup = cup;
  return rig;
}

const CupProfile kOwn{{{0.0, 0.006}, {0.024, 0.006}, {0.030, 0.026}, {0.038, 0.072}},
                      {{0.0, 0.0}, {0.026, 0.0}, {0.033, 0.026}, {0.041, 0.072}}};

TEST(OwnCup, IsInTheModelAsTheRigHasIt) {
  for (const std::string& name : library_names("cups")) {
    const NominalModel model = nominal_model(laboratory_with(library_cup(name).value(), name), "rig.json");
    EXPECT_TRUE(is_same_cup(model.cup, library_cup(name).value())) << name;
    EXPECT_EQ(model.cup.name, name) << "with its albedo and handle";
  }
  EXPECT_TRUE(is_same_cup(nominal_model(laboratory_with(kOwn, "cup"), "rig.json").cup, kOwn));
  EXPECT_TRUE(is_same_cup(nominal_model(laboratory_with(kOwn, "mug"), "rig.json").cup, kOwn));
  const CupProfile deeper = straight_cup(0.095, 0.008, 0.035, 0.039);
  EXPECT_TRUE(is_same_cup(nominal_model(laboratory_with(deeper, "mug"), "rig.json").cup, deeper));
}

/// A frame of it, without effects, says where it stands and how high its bottom is.
TEST(OwnCup, IsSeenWhereItStands) {
  for (const CupProfile& cup : {kOwn, library_cup("tapered_cup").value()})
    for (const double distance_mm : {200.0, 300.0}) {
      const LaboratoryRig rig = laboratory_with(cup, "cup");
      NominalModel model = nominal_model(rig, "rig.json");
      model.rig.sensor.law.quantized = false;
      const Factors shot = paper_shot("empty", 0.0, distance_mm, 60.0);
      const FrameView written{Eigen::Vector2d(0.060, 1e-3 * distance_mm)};
      const SurrogateFrame frame = surrogate_frame(setup_of(model, shot), rig, sample_pixels(rig, written));
      ASSERT_TRUE(frame.estimates);
      EXPECT_NEAR(frame.estimates->interior.mean, cup.bottom(), 2e-5);
      ASSERT_TRUE(frame.estimates->outline);
      EXPECT_LT(frame.estimates->outline->off.norm(), 1e-4);
      EXPECT_LT(std::abs(frame.estimates->outline->wider), 1e-4);
    }
}

/// As against many points of the way.
TEST(OwnCup, HidesTheDeskBehindIt) {
  const LaboratoryRig rig = laboratory_with(kOwn, "cup");
  const CupOptics optics =
      cup_optics(setup_of(nominal_model(rig, "rig.json"), paper_shot("empty", 0.0, 300.0))).value();
  const Eigen::Vector3d source(0.0375, 0.0, 0.650);
  int hidden = 0, seen = 0;
  for (double x = -0.12; x < 0.12; x += 0.007)
    for (double y = 0.2; y < 0.45; y += 0.007) {
      const Eigen::Vector3d on_desk(x, y, 0.0);
      double within = -1.0;  // [m] farthest inside the outer wall
      for (double height = 0.0; height <= kOwn.height(); height += 1e-5) {
        const Eigen::Vector3d at = on_desk + height / source.z() * (source - on_desk);
        within = std::max(within, kOwn.outer_radius(height) - (at.head<2>() - optics.body.axis).norm());
      }
      if (std::abs(within) < 1e-5) continue;  // less than the points are apart
      EXPECT_EQ(is_hidden(optics.body, on_desk, source), within > 0.0) << x << ", " << y;
      ++(within > 0.0 ? hidden : seen);
    }
  EXPECT_GT(hidden, 100);
  EXPECT_GT(seen, 100);
}

}  // namespace
}  // namespace fathom
