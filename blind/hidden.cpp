#include "blind/hidden.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/rng.h"
#include "core/units.h"

namespace fathom::blind {
namespace {

using P = const Placement&;

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr double kOpaqueMetres = 1e-6;  // free path by which a laboratory says that it believes a liquid opaque

const std::array kHidden{
    // The sensor.
    Hidden{"sensor_height", "height_mm", 0, 3, -15, 15, true,
           [](World& w, P, double mm) { w.sensor.height += metres_from_mm(mm); }},
    Hidden{"sensor_pitch", "pitch_deg", 0, 0.4, -2, 2, true,
           [](World& w, P, double deg) { w.sensor.pitch += radians_from_deg(deg); }},
    Hidden{"sensor_roll", "roll_deg", 0, 0.4, -2, 2, true,
           [](World& w, P, double deg) { w.sensor.roll += radians_from_deg(deg); }},
    Hidden{"baseline", "baseline_mm", 0, 0.4, -1.5, 1.5, true,
           [](World& w, P, double mm) { w.sensor.baseline += metres_from_mm(mm); }},
    Hidden{"focal_length", "focal_px", 0, 3, -8, 8, true, [](World& w, P, double px) { w.sensor.focal_px += px; }},
    Hidden{"principal_point", "x_px", 0, 3, -8, 8, true,
           [](World& w, P, double px) { w.sensor.principal_px.x() += px; }},
    Hidden{"disparity_offset", "offset_px", 0, 0.15, -0.5, 0.5, true,
           [](World& w, P, double px) { w.sensor.disparity_offset_px += px; }},
    Hidden{"radial_distortion", "k1", 0, 0.02, -0.1, 0.1, true,
           [](World& w, P, double k1) { w.sensor.radial_k1 += k1; }},
    Hidden{"depth_quantization", "step_px", 0.125, 0.375, 0.125, 0.875, true,
           [](World& w, P, double px) { w.sensor.steps_per_px = 1.0 / (0.125 + px); }},
    Hidden{"thermal_drift", "start_px", 0, 0.1, -0.4, 0.4, true, [](World& w, P, double px) { w.warm_up_px += px; }},
    Hidden{"depth_wander", "sd_px", 0, 0.03, 0.003, 0.3, true,
           [](World& w, P, double px) { w.wander_px = std::hypot(w.wander_px, px); }},
    // The liquid.
    Hidden{"refractive_index", "index_change", 0, 0.01, -0.03, 0.05, true,
           [](World& w, P p, double n) {
             if (p.liquid == "water") w.liquid->index += n;
           }},
    Hidden{"absorption", "absorption_per_mm", 0, 0.01, -0.003, 0.1, true,
           [](World& w, P p, double per_mm) {
             if (p.liquid == "water") w.liquid->absorption += per_metre_from_per_mm(per_mm);
           }},
    // Departs in the free path 1/μs′, which is next to 0 in what is opaque.
    Hidden{"subsurface_scattering", "transport_length_mm", 0, 0.5, 0.02, 4, true,
           [](World& w, P p, double mm) {
             if (p.liquid == "milk_tea") w.liquid->reduced_scattering = 1.0 / (kOpaqueMetres + metres_from_mm(mm));
           }},
    Hidden{"stratification", "index_step", 0, 0.02, 0.001, 0.06, true,
           [](World& w, P p, double n) {
             if (p.liquid == "water") w.liquid->deep_index_excess += n;
           }},
    // Its surface.
    Hidden{"meniscus", "contact_angle_deg", 90, -45, -80, 40, true,
           [](World& w, P, double deg) { w.top.contact_angle = kHalfPi + radians_from_deg(deg); }},
    Hidden{"surface_tilt", "slope_y_deg", 0, 1, 0.02, 6, true,
           [](World& w, P, double deg) { w.top.slope_y += std::tan(radians_from_deg(deg)); }},
    Hidden{"foam", "thickness_mm", 0, 0.5, 0.02, 5, true,
           [](World& w, P, double mm) {
             w.top.foam_cover = 0.9;
             w.top.foam_thickness = metres_from_mm(mm);
           }},
    Hidden{"ripples", "amplitude_mm", 0, 0.15, 0.005, 0.6, true,
           [](World& w, P p, double mm) {
             w.top.ripple_amplitude = metres_from_mm(mm);
             w.top.ripple_phase = 2.0 * std::numbers::pi * Rng(0x219, p.number).uniform();
           }},
    // The cup.
    Hidden{"cup_bottom_height", "height_mm", 0, 0.7, -4, 6, true,
           [](World& w, P, double mm) { w.cup.bottom += metres_from_mm(mm); }},
    Hidden{"concave_bottom", "depth_mm", 0, 1, 0.05, 5, true,
           [](World& w, P, double mm) { w.cup.dish = metres_from_mm(mm); }},
    Hidden{"wall_albedo", "albedo", 0, -0.2, -0.6, 0.28, true, [](World& w, P, double a) { w.cup.wall_albedo += a; }},
    Hidden{"cup_placement", "y_mm", 0, 2, -8, 8, true,
           [](World& w, P, double mm) { w.cup.centre.y() += metres_from_mm(mm); }},
    // Light that goes other ways.
    Hidden{"wall_multipath", "share", 0, 0.3, 0.01, 1.0, true,
           [](World& w, P, double share) { w.cup.wall_gloss = share; }},
    Hidden{"specular_ghost", "share", 0, 1, 0.2, 1, true, [](World& w, P, double gain) { w.ghost_gain = gain; }},
    // Filling.
    Hidden{"fill_offset", "fill_mm", 0, 1, -5, 5, true,
           [](World& w, P, double mm) {
             if (w.fill > 0.0) w.fill = std::max(1e-3, w.fill + metres_from_mm(mm));
           }},
    Hidden{"fill_scale", "scale", 0, 0.06, -0.3, 0.3, true, [](World& w, P, double share) { w.fill *= 1.0 + share; }},
    Hidden{"evaporation", "rate_mm_per_h", 0, 6, 0.1, 60, true,
           [](World& w, P, double mm_per_h) {
             if (w.fill > 0.0) w.fill = std::max(1e-3, w.fill - metres_from_mm(mm_per_h) * w.since_poured / 3600.0);
           }},
    // The device's processing.
    Hidden{"window_averaging", "window_px", 9, 8, 2, 24, true,
           [](World& w, P, double px) { w.sensor.window_px = 9 + 2 * static_cast<int>(std::lround(0.5 * px)); }},
    // Never registered.
    Hidden{"wall_caustic", "pull_px", 0, 0.4, -2, 2, false, [](World& w, P, double px) { w.cup.caustic = px; }},
    // What stays at its place in all frames is the unit's own bias: in the first session the lens is clean and the stand
    // still.
    Hidden{"dirty_lens", "disparity_px", 0, 0.3, -1.5, 1.5, false,
           [](World& w, P p, double px) {
             if (p.session > 0) w.strange.lens_patch_px = px;
           }},
    Hidden{"rolling_exposure", "disparity_px", 0, 0.1, -0.6, 0.6, false,
           [](World& w, P p, double px) {
             if (p.session == 0) return;
             w.strange.rolling_px = px;
             w.strange.rolling_phase = 2.0 * std::numbers::pi * Rng(0x2011, p.session).uniform();
           }},
    Hidden{"vibration", "disparity_px", 0, 0.05, 0.005, 0.5, false,
           [](World& w, P, double px) { w.strange.vibration_px = px; }},
};

}  // namespace

std::span<const Hidden> hidden_effects() { return kHidden; }

const Hidden& hidden_effect(std::string_view name) {
  for (const Hidden& effect : kHidden)
    if (effect.name == name) return effect;
  throw std::logic_error("no such effect: " + std::string(name));
}

bool shows_in_spread(const Hidden& effect) { return effect.name == "depth_wander" || effect.name == "vibration"; }
bool shows_in_steps(const Hidden& effect) { return effect.name == "depth_quantization"; }
bool shows_in_means(const Hidden& effect) { return !shows_in_spread(effect) && !shows_in_steps(effect); }
bool passes_for_the_unit(const Hidden& effect) { return effect.name == "radial_distortion"; }
bool shows_by_session(const Hidden& effect) { return effect.name == "dirty_lens" || effect.name == "rolling_exposure"; }
bool shows_over_time(const Hidden& effect) { return effect.name == "thermal_drift" || effect.name == "evaporation"; }
bool differs_by_placement(const Hidden& effect) {
  return shows_over_time(effect) || shows_by_session(effect) || effect.name == "ripples";
}

void apply_all(World& world, const Placement& placement, std::span<const Active> effects) {
  for (const Active& active : effects) active.effect->apply(world, placement, active.departure);
}

}  // namespace fathom::blind
