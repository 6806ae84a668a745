#include "trials/random_desk.h"

#include <algorithm>

#include "core/error.h"
#include "core/timed.h"
#include "core/units.h"
#include "detector/make_template.h"
#include "sim/render/intersect.h"
#include "sim/scene/cup.h"
#include "sim/scene/scene.h"

namespace fathom {
namespace {

/// Of each object of the geometry the owner of its pixels.
std::vector<int> owner_of_objects(const Geometry& geometry) {
  std::vector<int> owners(geometry.objects.size() + 1, LabelledFrame::kNobody);
  int owner = 0;
  for (const CupObjects& cup : geometry.cups) {
    owners[cup.cup] = owner;
    if (cup.liquid) owners[*cup.liquid] = owner;
    ++owner;
  }
  for (const int thing : geometry.things) owners[thing] = owner++;
  return owners;
}

Image<int> owners_of(const Geometry& geometry, const Image<TruePixel>& truth) {
  const std::vector<int> owner = owner_of_objects(geometry);
  Image<int> owners(truth.width(), truth.height());
  std::transform(truth.pixels().begin(), truth.pixels().end(), owners.pixels().begin(),
                 [&](const TruePixel& pixel) { return owner.at(pixel.object); });
  return owners;
}

int pixels_of(int owner, const Image<int>& owners) {
  return static_cast<int>(std::count(owners.pixels().begin(), owners.pixels().end(), owner));
}

/// Pixels that a cup would fill alone on the desk.
int pixels_alone(const Setup& setup, const Cup& cup) {
  const Scene alone{.desk = setup.scene.desk, .cups = {cup}, .objects = {}};
  const Geometry geometry = build_geometry(alone, setup.rig.sensor.wavelength_nm);
  const Intersector world(geometry);
  const PointLight projector(world, setup.rig.projector_in_world());
  return pixels_of(0, owners_of(geometry, trace_truth(projector, setup.rig)));
}

TrialCup true_cup(const Cup& cup, const Rig& rig) {
  TrialCup result;
  result.shape = cup_name(cup);
  result.liquid = cup.filling ? cup.filling->medium.name : "empty";
  result.fill_mm = cup.filling ? mm_from_metres(cup.filling->depth) : 0.0;
  if (cup.filling)
    result.kind = name_of(cup.filling->medium.scatters() ? LiquidKind::kOpaque : LiquidKind::kTransparent);
  result.position_mm = cup.position / kMetresPerMm;
  const Eigen::Vector3d foot(cup.position.x(), cup.position.y(), 0.0);
  result.distance_mm = mm_from_metres((foot - rig.camera_in_world()).norm());
  return result;
}

LabelledFrame labelled(const Setup& setup, const Camera& camera, const Frame& frame, std::string sensor) {
  const Rig& rig = setup.rig;
  LabelledFrame result{.sensor = std::move(sensor),
                       .world_from_camera = rig.world_from_camera,
                       .focal_px = rig.sensor.focal_px,
                       .principal_px = rig.sensor.principal_px,
                       .cloud = cloud_from_image(frame.cloud),
                       .owners = owners_of(camera.geometry(), camera.truth())};
  for (const Cup& cup : setup.scene.cups) {
    const int seen = pixels_of(static_cast<int>(result.cups.size()), result.owners), whole = pixels_alone(setup, cup);
    result.cups.push_back(true_cup(cup, rig));
    result.cups.back().visible = whole == 0 ? 0.0 : static_cast<double>(seen) / whole;
  }
  for (const Object& object : setup.scene.objects) result.others.push_back(object_name(object));
  return result;
}

}  // namespace

DeskShot shoot_desk(const Json& scene, const std::string& file, std::uint64_t seed) {
  double shoot_s = 0.0;
  Setup setup = setup_from_json(scene, file);
  Frame frame;
  Camera camera = timed(shoot_s, [&] {
    Camera result(setup, CaptureMode::photometric, kDefaultSamplesPerPixel, seed, LightModel::direct);
    frame = result.shoot(0);
    return result;
  });
  LabelledFrame truth = labelled(setup, camera, frame, scene.at("sensor").value("model", ""));
  return {std::move(setup), std::move(camera), std::move(frame), std::move(truth), shoot_s};
}

std::vector<CupTemplate> templates_of(const ClutterSpec& clutter) {
  std::vector<CupTemplate> templates;
  for (const ClutterThing& kind : clutter.cup_kinds) {
    Json cup = kind.entry;
    cup["position_mm"] = {mm_from_metres(clutter.region.center().x()), mm_from_metres(clutter.region.min().y())};
    Setup setup = setup_from_json({{"sensor", clutter.sensor}, {"desk", clutter.desk}, {"cups", {cup}}}, clutter.file);
    setup.rig.sensor.noise = {};
    const Frame frame = Camera(setup, CaptureMode::geometric, 1, 0).shoot(0);
    try {
      templates.push_back(template_of_only_cup(cup_name(setup.scene.cups.front()), cloud_from_image(frame.cloud),
                                               prior_of(setup.rig.world_from_camera), std::nullopt, "template's desk"));
    } catch (const Error&) {
      continue;
    }
  }
  return templates;
}

}  // namespace fathom
