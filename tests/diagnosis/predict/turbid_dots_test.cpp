// From how deep a turbid liquid's light seems to come and what is left of its dots: limits, and whole frames.
#include "diagnosis/predict/turbid_dots.h"

#include <gtest/gtest.h>

#include "diagnosis/predict/cup_optics.h"
#include "diagnosis/predict/device_reader.h"
#include "diagnosis/predict/surrogate.h"
#include "sim/sensor/capture.h"
#include "tests/diagnosis/predict/paper_laboratory.h"

namespace fathom {
namespace {

TEST(SeenDepth, IsThatOfSingleScatteringWhereDotsAreSmall) {
  // Of what scatters once e^(-2 z / path) comes back, whose mean depth is half a path. A core of an eighth of one lets
  // in 1 % of the rest.
  EXPECT_NEAR(seen_depth(0.0625), 0.5, 0.01);
}

TEST(SeenDepth, RisesTowardsAPathWithTheDots) {
  double last = 0.0;
  for (double core = 0.125; core <= 64.0; core *= 2.0) {
    EXPECT_GT(seen_depth(core), last) << core;
    last = seen_depth(core);
  }
  EXPECT_LT(last, 1.0);  // first and last flight are of a path each, but for light that scatters few times
  EXPECT_GT(last, 0.9);
}

// Light takes the same ways back: where camera and projector change places, it enters where it left.
TEST(SeenDepth, IsTheSameFromEitherSide) {
  const Factors factors = paper_shot("milk", 30.0, 300.0);
  const fathom::Setup setup =
      paper_setup(factors, Json::parse(R"([{"name": "subsurface_scattering", "transport_length_mm": 2}])"));
  const CupOptics optics = cup_optics(setup).value();
  const Eigen::Vector3d camera = setup.rig.camera_in_world(), projector = setup.rig.projector_in_world();
  /// Where light that is seen at a point of the surface entered it.
  const auto entry = [&](const Eigen::Vector3d& seen, const Eigen::Vector3d& from, const Eigen::Vector3d& source) {
    const LitPoint lit = look_into(optics, {from, (seen - from).normalized()}, source).value();
    const Eigen::Vector3d way = lit.projector_direction;
    return Eigen::Vector3d(source + (lit.point.z() - source.z()) / way.z() * way);
  };
  const double level = optics.layers.front().at;
  for (const Eigen::Vector3d& seen : {Eigen::Vector3d(0.0, 0.3, level), Eigen::Vector3d(0.01, 0.31, level)}) {
    const Eigen::Vector3d entered = entry(seen, camera, projector);
    EXPECT_GT((entered - seen).norm(), 5e-5);
    // Directions are taken at the one point for both, which a path of 2 mm makes 1 µm of.
    EXPECT_LT((entry(entered, projector, camera) - seen).norm(), 1e-6);
  }
}

/// Height [m] above the desk of a wide vessel of milk, within 80 mm of its middle.
struct Height {
  double whole;  ///< mean, of an image in all its light
  double few;    ///< mean of the surrogate's rays
};

/// Seen from 0.7 m.
fathom::Setup wide_vessel_of_milk(double transport_length_mm) {
  LaboratoryRig rig = paper_laboratory();
  rig.liquids["milk"] = Json{{"index", 1.336}, {"scattering_per_mm", 1000.0}, {"absorption_per_mm", 0.0032}};
  NominalModel model = nominal_model(rig, "rig.json");
  model.rig.sensor.law.quantized = false;
  const Factors factors = paper_shot("milk", 30.0, 300.0);
  Setup setup = setup_of(model, factors);
  CupShape& shape = std::get<CupShape>(setup.scene.cups[0].shape);
  constexpr double kWider = 2.5;  // a cup holds too few windows
  for (auto* profile : {&shape.inner, &shape.outer})
    for (Eigen::Vector2d& point : *profile) point.x() *= kWider;
  if (transport_length_mm > 0.0)
    setup.effects = Json{{{"name", "subsurface_scattering"}, {"transport_length_mm", transport_length_mm}}};
  return with_effects(std::move(setup));
}

Height height_of_milk(double transport_length_mm) {
  const fathom::Setup setup = wide_vessel_of_milk(transport_length_mm);
  constexpr int kSamples = 4;
  Camera camera(setup, CaptureMode::photometric, kSamples, 1);
  const Frame frame = camera.shoot(0);
  const CupOptics optics = cup_optics(setup).value();
  const DeviceReader read(setup);
  const Eigen::Vector3d projector = read.rig().projector_in_world();
  const auto look = [&](const Ray& sight) -> std::optional<SeenLight> {
    const auto lit = look_into(optics, sight, projector);
    if (!lit) return std::nullopt;
    return SeenLight{lit->projector_direction, lit->reflected};
  };
  const Pose& world_from_camera = setup.rig.world_from_camera;
  Height sum{0.0, 0.0};
  int count = 0;
  for (int y = 0; y < frame.cloud.height(); ++y)
    for (int x = 0; x < frame.cloud.width(); ++x) {
      const CloudPoint& p = frame.cloud(x, y);
      const auto few = read({x + 0.5, y + 0.5}, 1.0, look);
      if (!few || !(p.z > 0.0f)) continue;
      const Eigen::Vector3d there = world_from_camera * few->point.cast<double>();
      if ((there.head<2>() - Eigen::Vector2d(0.0, 0.3)).norm() > 0.08) continue;
      sum.whole += (world_from_camera * Eigen::Vector3d(p.x, p.y, p.z)).z();
      sum.few += there.z();
      ++count;
    }
  return {sum.whole / count, sum.few / count};
}

TEST(SeenDepth, LowersASurfaceAsWholeFramesHaveIt) {
  const Height opaque = height_of_milk(0.0), turbid = height_of_milk(2.0);
  const double few_mm = mm_from_metres(turbid.few - opaque.few), whole_mm = mm_from_metres(turbid.whole - opaque.whole);
  // Two standard errors of the frame's, 0.05 mm by what blocks of 20 pixels differ. Surfaces whose light is displaced
  // by all of its centroid, and from the projector's side alone, would lie at -0.52 mm.
  EXPECT_NEAR(few_mm, whole_mm, 0.1);
  EXPECT_LT(whole_mm, -0.5);
}

TEST(DotContrast, FallsFromOneToTheLightThatLeavesWhereItEntered) {
  double last = 0.0;
  for (double core = 0.0625; core <= 64.0; core *= 2.0) {
    EXPECT_GT(dot_contrast(core), last) << core;
    last = dot_contrast(core);
  }
  EXPECT_NEAR(last, 1.0, 0.05);
  // Of what a half-space sends back along the normal 1 / H(1)² = 0.118 has scattered once (Chandrasekhar 1950, of even
  // scattering without absorption). The surface throws light back into it, so that more scatters again.
  EXPECT_LT(dot_contrast(0.0625), 0.118);
  EXPECT_GT(dot_contrast(0.0625), 0.08);
}

/// Of the dots in the middle of a wide vessel of milk, whose walls are out of the way, over those on the desk.
double log_contrast_in_frames(const fathom::Setup& setup) {
  constexpr int kSamples = 4;
  Camera camera(setup, CaptureMode::photometric, kSamples, 1);
  const Frame frame = camera.shoot(0);
  DotContrast inside, desk;
  for (const CloudPoint& p : frame.cloud.pixels()) {
    if (!(p.z > 0.0f)) continue;
    const Eigen::Vector3d there = setup.rig.world_from_camera * Eigen::Vector3d(p.x, p.y, p.z);
    const double from_axis = (there.head<2>() - Eigen::Vector2d(0.0, 0.3)).norm();
    if (from_axis < 0.03) inside.add(p.intensity, 1.0);
    if (from_axis > 0.12 && from_axis < 0.2) desk.add(p.intensity, 1.0);
  }
  return std::log(inside.contrast() / desk.contrast());
}

/// In a black vessel: white walls light the middle evenly, which few rays do not know. Frames have 17 % less contrast
/// than few rays say; why is open.
TEST(DotContrast, IsThatOfWholeFrames) {
  fathom::Setup setup = wide_vessel_of_milk(0.8);
  std::get<CupShape>(setup.scene.cups[0].shape).albedo = 0.0;
  const double in_frames = log_contrast_in_frames(setup);
  EXPECT_NEAR(log_contrast_of_dots(setup), in_frames, 0.2);
  EXPECT_LT(in_frames, -1.0);
}

}  // namespace
}  // namespace fathom
