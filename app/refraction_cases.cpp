// What refraction at a smooth surface is certified by: the angles where Fresnel's reflectance is 0 and 1, and how deep
// water looks.
#include <cmath>

#include "app/verify_cases.h"
#include "core/units.h"
#include "sim/optics/fresnel.h"
#include "sim/render/truth.h"
#include "sim/scene/setup.h"

namespace fathom {
namespace {

constexpr double kRightAngleDeg = 90.0;

double cosine_of(double angle_deg) { return std::cos(radians_from_deg(angle_deg)); }

/// Where light polarised in the plane of incidence is reflected least: its reflectance falls, then rises.
double brewster_angle_deg(double n_from, double n_to) {
  double low = 0.0, high = kRightAngleDeg;
  while (high - low > 1e-9) {
    const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
    const bool falls = polarised_reflectance(cosine_of(left), n_from, n_to).p >
                       polarised_reflectance(cosine_of(right), n_from, n_to).p;
    (falls ? low : high) = falls ? left : right;
  }
  return low;
}

/// From where on all light is reflected.
double critical_angle_deg(double n_from, double n_to) {
  double low = 0.0, high = kRightAngleDeg;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (fresnel_reflectance(cosine_of(middle), n_from, n_to) < 1.0 ? low : high) = middle;
  }
  return high;
}

constexpr double kWaterIndex = 1.3281, kWaterDepthMm = 50.0, kBasinBottomMm = 1.0;

/// A sensor that looks at the middle of a wide basin of water at an angle of incidence, 600 mm of air before it.
Setup basin_setup(double incidence_deg, double baseline_mm) {
  constexpr double kRangeMm = 600.0;
  const double incidence = radians_from_deg(incidence_deg);
  const double level_mm = kBasinBottomMm + kWaterDepthMm;
  const Json sensor{{"model", "xtion_pro_live"},
                    {"height_mm", level_mm + kRangeMm * std::cos(incidence)},
                    {"pitch_deg", kRightAngleDeg - incidence_deg},
                    {"baseline_mm", baseline_mm}};
  const Json basin{{"shape",
                    {{"height_mm", level_mm + 1.0},
                     {"bottom_mm", kBasinBottomMm},
                     {"inner_radius_mm", 200.0},
                     {"outer_radius_mm", 201.0}}},
                   {"position_mm", {0.0, kRangeMm * std::sin(incidence)}},
                   {"liquid", {{"index", kWaterIndex}}},
                   {"fill_mm", kWaterDepthMm}};
  return setup_from_json({{"sensor", sensor}, {"cups", Json::array({basin})}}, "basin of water");
}

/// Apparent over true depth at the point where the line of sight from half-way between camera and projector ends.
double apparent_depth_ratio(double incidence_deg, double baseline_mm) {
  const Setup setup = basin_setup(incidence_deg, baseline_mm);
  const Rig& rig = setup.rig;
  const Geometry geometry = build_geometry(setup.scene, rig.sensor.wavelength_nm);
  const Intersector world(geometry);
  const Eigen::Vector3d camera = rig.camera_in_world(), projector = rig.projector_in_world();
  const Eigen::Vector3d forward = rig.world_from_camera.linear().col(2);
  const SeenPoint target = *see(world, {0.5 * (camera + projector), forward});
  // Light that goes from the camera to the point goes the way by which the camera sees it.
  const Ray sight{camera, illuminate(PointLight(world, camera), target)->direction};
  const Illumination light = *illuminate(PointLight(world, projector), *see(world, sight));
  const double apparent_depth = *triangulated_depth(rig, sight.direction, light.direction);
  const double measured_z = camera.z() + sight.direction.z() * apparent_depth / sight.direction.dot(forward);
  return (metres_from_mm(kBasinBottomMm + kWaterDepthMm) - measured_z) / metres_from_mm(kWaterDepthMm);
}

std::vector<Estimate> apparent_depth_ratios(std::initializer_list<double> incidences_deg, double baseline_mm) {
  std::vector<Estimate> ratios;
  for (const double incidence_deg : incidences_deg)
    ratios.push_back({apparent_depth_ratio(incidence_deg, baseline_mm), 0.0});
  return ratios;
}

}  // namespace

const std::vector<VerifyCase>& refraction_cases() {
  static const std::vector<VerifyCase> cases{
      {"fresnel n 1.328, angles [deg]",
       {{"Brewster", 53.02, 5e-3}, {"critical", 48.85, 5e-3}},
       "Born & Wolf, 1.5.3 and 1.5.4, evaluated",
       [](std::uint64_t, const SamplingPlan&) {
         return std::vector<Estimate>{{brewster_angle_deg(1.0, 1.328), 0.0}, {critical_angle_deg(1.328, 1.0), 0.0}};
       }},
      {"apparent over true depth n 1.3281, short baseline",
       {{"0 deg", 0.75296, 5e-6}, {"30 deg", 0.70386, 5e-6}, {"45 deg", 0.62898, 5e-6}, {"60 deg", 0.49657, 5e-6}},
       "Hara et al. 2014, Eq. 1 and 2: cos A / sqrt(n^2 - sin^2 A)",
       [](std::uint64_t, const SamplingPlan&) {
         constexpr double kShortMm = 1.0;  // of 600 mm: the ratio is 1e-7 from that of no baseline
         return apparent_depth_ratios({0.0, 30.0, 45.0, 60.0}, kShortMm);
       }},
      {"apparent over true depth n 1.3281, baseline 75 mm",
       {{"0 deg", 0.75239, 5e-6}, {"45 deg", 0.62832, 5e-6}, {"60 deg", 0.49592, 5e-6}},
       "two rays by Snell's law: 600 mm of air on the line of sight, 50 mm of water",
       [](std::uint64_t, const SamplingPlan&) {
         return apparent_depth_ratios({0.0, 45.0, 60.0}, 75.0);
       }},
  };
  return cases;
}

}  // namespace fathom
