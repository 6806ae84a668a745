#include "blind/laboratory.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rng.h"
#include "core/units.h"

namespace fathom::blind {
namespace {

enum class Stream : std::uint64_t { rig = 101, session, fill, place, dust };

const std::array kRig{
    Uncertain{"height_mm", 0.5, [](World& w, double mm) { w.sensor.height += metres_from_mm(mm); }},
    Uncertain{"pitch_deg", 0.05, [](World& w, double deg) { w.sensor.pitch += radians_from_deg(deg); }},
    Uncertain{"roll_deg", 0.05, [](World& w, double deg) { w.sensor.roll += radians_from_deg(deg); }},
    Uncertain{"baseline_mm", 0.05, [](World& w, double mm) { w.sensor.baseline += metres_from_mm(mm); }},
    Uncertain{"focal_px", 0.4, [](World& w, double px) { w.sensor.focal_px += px; }},
    Uncertain{"disparity_offset_px", 0.02, [](World& w, double px) { w.sensor.disparity_offset_px += px; }},
    Uncertain{"bottom_mm", 0.1, [](World& w, double mm) { w.cup.bottom += metres_from_mm(mm); }},
};

/// Set up anew, the rig stands so much otherwise [mm, deg, px].
const std::array kSession{
    SessionError{0.1, [](World& w, double mm) { w.sensor.height += metres_from_mm(mm); }},
    SessionError{0.02, [](World& w, double deg) { w.sensor.pitch += radians_from_deg(deg); }},
    SessionError{0.005, [](World& w, double px) { w.sensor.disparity_offset_px += px; }},
};

const std::array kDust{
    Uncertain{"pattern_bend_px", 0.02, [](World& w, double px) { w.dust.pattern_bend_px += px; }},
    Uncertain{"band_px", 0.006, [](World& w, double px) { w.dust.band_px += px; }},
    Uncertain{"bright_px", 0.004, [](World& w, double px) { w.dust.bright_px += px; }},
};

}  // namespace

World believed(const Placement& placement) {
  World world;
  world.sensor.pitch = std::atan2(0.650, 0.400);  // aims at the middle of the distances
  world.cup.centre = {placement.lateral, placement.distance};
  world.seconds = placement.time_s;
  world.since_poured = placement.since_poured_s;
  world.fill = placement.fill;
  if (placement.liquid == "water") world.liquid = Liquid{.index = 1.3281, .absorption = 3.1};
  // Opaque, as far as the laboratory knows: a free path of a micrometre.
  if (placement.liquid == "milk_tea")
    world.liquid = Liquid{.index = 1.336, .absorption = 3.2, .reduced_scattering = 1e6};
  if (placement.liquid == "opaque_liquid")
    world.liquid = Liquid{.index = 1.34, .absorption = 3.0, .reduced_scattering = 1e6};
  return world;
}

std::span<const Uncertain> uncertain_rig() { return kRig; }

Json rig_json() {
  Json sensor_sigma = Json::object(), cup_sigma = Json::object();
  for (const Uncertain& value : uncertain_rig())
    (value.name == "bottom_mm" ? cup_sigma : sensor_sigma)[std::string(value.name)] = value.sigma;
  const World world = believed({});
  return {{"sensor",
           {{"model", "xtion_pro_live"},
            {"height_mm", 650},
            {"pitch_deg", std::round(1e6 * deg_from_radians(world.sensor.pitch)) / 1e6},
            {"roll_deg", 0},
            {"baseline_mm", 75},
            {"focal_px", 570.342},
            {"disparity_offset_px", 0},
            {"sigma", sensor_sigma}}},
          {"cup",
           {{"shape", "paper_cup"},
            {"height_mm", 87},
            {"inner_radius_mm", 40},
            {"outer_radius_mm", 43},
            {"bottom_mm", 7},
            {"sigma", cup_sigma}}},
          {"liquids",
           {{"water", "water"},
            {"milk_tea",
             {{"index", 1.336}, {"absorption_per_mm", 0.0032}, {"scattering_per_mm", 1000}, {"anisotropy", 0}}}}},
          {"fill_sigma_mm", mm_from_metres(kFillSigma)},
          {"placement_sigma_mm", mm_from_metres(kPlacementSigma)}};
}

std::span<const SessionError> session_errors() { return kSession; }
std::span<const Uncertain> dust() { return kDust; }

World true_world(const Placement& placement, std::uint64_t seed, double scale) {
  World world = believed(placement);
  Rng rig(seed, Stream::rig);
  for (const Uncertain& value : kRig) value.add(world, scale * value.sigma * rig.normal());
  Rng session(seed, Stream::session, placement.session);
  for (const SessionError& error : kSession) error.add(world, scale * error.sigma * session.normal());
  if (world.fill > 0.0)
    world.fill = std::max(1e-3, world.fill + scale * kFillSigma * Rng(seed, Stream::fill, placement.pour).normal());
  Rng place(seed, Stream::place, placement.number);
  world.cup.centre.x() += scale * kPlacementSigma * place.normal();
  world.cup.centre.y() += scale * kPlacementSigma * place.normal();
  world.noise_scale = scale;
  world.unit = draw_unit(seed);
  Rng specks(seed, Stream::dust);
  for (const Uncertain& value : kDust) value.add(world, value.sigma * specks.normal());
  return world;
}

}  // namespace fathom::blind
