#include "diagnosis/predict/model_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "core/median.h"
#include "core/units.h"
#include "diagnosis/predict/nuisances.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

/// What observations of an observable have in common that have the same error.
enum SharedBy : unsigned {
  kAllShare = 0,
  kSameRegion = 1,
  kSameSession = 2,
  kSamePlace = 4,
  kSameLiquid = 8,
  kSameFill = 16,
  kSameFilling = kSameLiquid | kSameFill,
  kSameCondition = kSameFilling | kSamePlace
};

/// What few rays and direct light leave out of an observable, in its unit. Of heights, walls and the desk's plane these
/// are root mean squares of the standard deviations that bench/model_errors.py finds for two matchers, as nobody knows
/// how a laboratory's device matches: for Fathom's, over photometric campaigns of twelve simulated devices (geometric
/// ones have less), and for OpenCV's on the infrared images of twelve others. Patterns, blocks, cups and fills are each
/// campaign's own; those of shapes are of twelve devices in all, and of placements that show four squares or more.
/// Where a reason stands beside a size, it is the reason that counts.
struct ModelError {
  std::string_view observable;
  double sigma;
  unsigned shared_by;      ///< of SharedBy
  double of_pixels = 0.0;  ///< of a mean of so many, and more of fewer; 0: of all alike
};
constexpr double kOfWalls_px = 1000.0;
constexpr std::array kModelErrors{
    ModelError{"height_mm", 0.05, kAllShare}, ModelError{"height_mm", 0.07, kSameLiquid | kSameRegion},
    ModelError{"height_mm", 0.06, kSamePlace}, ModelError{"height_mm", 0.085, kSamePlace | kSameRegion},
    ModelError{"height_mm", 0.09, kSameCondition}, ModelError{"height_mm", 0.14, kSameCondition | kSameRegion},
    // Of a device's pixels a hundredth is matched wrongly, of dark bottoms more.
    ModelError{"stray_share", 0.02, kAllShare}, ModelError{"stray_share", 0.03, kSameLiquid},
    ModelError{"stray_share", 0.03, kSameCondition | kSameRegion}, ModelError{"content_shape_mm", 0.11, kSameRegion},
    ModelError{"content_shape_mm", 0.17, kSameLiquid | kSameRegion},  // 0.20, less the 0.1 by which placements scatter
    ModelError{"cup_x_mm", 0.13, kAllShare}, ModelError{"cup_x_mm", 0.10, kSamePlace, kOfWalls_px},
    ModelError{"cup_x_mm", 0.06, kSameCondition, kOfWalls_px}, ModelError{"cup_y_mm", 0.68, kAllShare},
    ModelError{"cup_y_mm", 0.12, kSamePlace, kOfWalls_px}, ModelError{"cup_y_mm", 0.03, kSameCondition, kOfWalls_px},
    ModelError{"cup_radius_mm", 0.30, kAllShare},  // cups are round and straight to some tenths of a millimetre
    ModelError{"cup_radius_mm", 0.07, kSamePlace, kOfWalls_px},
    ModelError{"cup_radius_mm", 0.03, kSameCondition, kOfWalls_px},
    ModelError{"desk_height_mm", 0.05, kAllShare},  // beside a plane of bias, which is a nuisance
    ModelError{"desk_height_mm", 0.003, kSameCondition}, ModelError{"desk_pitch_deg", 0.026, kAllShare},
    ModelError{"desk_pitch_deg", 0.002, kSameCondition}, ModelError{"desk_roll_deg", 0.010, kAllShare},
    ModelError{"desk_roll_deg", 0.003, kSameCondition},
    ModelError{"desk_residual_mm", 0.10, kSameRegion},  // a matcher's bias by place; a Kinect has -0.3 to 0.7 mm
    ModelError{"log_brightness", 0.30, kAllShare},      // nobody wrote down albedos; walls light the bottom
    ModelError{"log_brightness", 0.50, kSameLiquid},    // what scatters has an albedo of its own
    ModelError{"log_brightness", 0.05, kSamePlace},     // vignetting, and what of the inside is seen
    ModelError{"log_brightness", 0.05, kSameCondition},
    // Walls light a bottom of their own colour evenly: of its dots' contrast three quarters are left
    // (detector/content_signs.h).
    ModelError{"log_ir_contrast", 0.30, kAllShare}, ModelError{"log_ir_contrast", 0.10, kSameFilling},
    ModelError{"log_ir_contrast", 0.05, kSamePlace}, ModelError{"log_ir_contrast", 0.15, kSameCondition},
    // Smooth errors of a frame, a quarter of a step of 1/8 px over 40 px, lift and turn a fitted desk by so much.
    ModelError{"desk_wander_mm", 0.05, kAllShare}, ModelError{"desk_pitch_motion_deg", 0.01, kAllShare},
    ModelError{"desk_roll_motion_deg", 0.02, kAllShare}, ModelError{"liquid_motion_mm", 0.05, kAllShare},
    ModelError{"comb_strength", 0.10, kSameSession},  // depths are no even mixture of steps
    ModelError{"comb_quarter", 0.05, kSameSession},   // what teeth a desk's own codes have
    ModelError{"comb_half", 0.05, kSameSession},
    // Matchers draw disparities towards whole pixels, A sin 2πd with A up to 0.1 px (Shimizu & Okutomi, IJCV 63, 2005).
    // Then a comb of 1/2 px is as strong as the Bessel function J₂(4πA), of 1/4 px as J₄(8πA).
    ModelError{"comb_quarter", 0.075, kAllShare}, ModelError{"comb_half", 0.17, kAllShare},
    ModelError{"millimetre_comb", 0.02, kAllShare}};

/// The same of an effect, above clear liquids or everywhere.
struct EffectError {
  std::string_view effect;
  ModelError error;
  std::optional<double> grows_from{};
  bool everywhere = false;
};
/// Foam has holes where nothing is seen. Of a window of 11 mm, 0.7 m away, cells of 6 mm that lack a tenth shift the
/// middle of its light by half a pixel; across it heights differ by 0.7 mm a pixel. A region holds few such windows.
/// Waves are of any length, and move a region by as much as that has it; a matcher that loses smeared dots makes
/// the deeper bottoms of whole frames darker than direct light has them. Under 30 mm of water the usual waves (a slope
/// of 0.05 along the baseline) displace what either ray meets by 0.4 mm, so that heights, 0.7 m away, spread by 5 mm:
/// which of them a matcher keeps is its own, and moves regions by a millimetre. How far each shot is off its mean
/// is in the scatter of heights. Wide windows hold two surfaces: which they read, and where they have them, is the
/// matcher's. What windows of a device's width do so is in the errors above.
constexpr double kUsualWindows = (kDeviceWindow_px - kNoWindow_px) / 8.0;  // px, over a typical departure
constexpr std::array kEffectErrors{
    EffectError{"foam", {"height_mm", 0.3, kSameLiquid | kSameRegion}},     // the same holes at each pour, …
    EffectError{"foam", {"height_mm", 0.3, kSamePlace | kSameRegion}},      // … seen from elsewhere, …
    EffectError{"foam", {"height_mm", 0.3, kSameCondition | kSameRegion}},  // … by other dots
    EffectError{"foam", {"liquid_motion_mm", 0.3, kSameFilling}},
    EffectError{"foam", {"log_ir_contrast", 0.5, kSameFilling}},          // bubbles scatter
    EffectError{"ripples", {"log_ir_contrast", 0.3, kSameFilling}, 0.0},  // as lenses do, waves gather and spread dots
    EffectError{"ripples", {"log_brightness", 0.08, kSameFilling}, 0.0},
    EffectError{"ripples", {"liquid_motion_mm", 0.5, kSameFilling}, 0.0},
    EffectError{"ripples", {"stray_share", 0.2, kSameCondition}, 0.0},
    EffectError{"ripples", {"stray_share", 0.1, kSameCondition | kSameRegion}, 0.0},
    EffectError{"window_averaging", {"height_mm", 0.12, kSamePlace | kSameRegion}, kUsualWindows, true},
    EffectError{"window_averaging", {"height_mm", 0.12, kSameCondition | kSameRegion}, kUsualWindows, true},
    EffectError{"window_averaging", {"cup_x_mm", 0.4, kSameCondition}, kUsualWindows, true},
    EffectError{"window_averaging", {"cup_y_mm", 0.4, kSameCondition}, kUsualWindows, true},
    EffectError{"window_averaging", {"cup_radius_mm", 0.4, kSameCondition}, kUsualWindows, true}};

/// Never empty: that would be no group.
std::string shared_key(const Observation& observation, unsigned shared_by) {
  const Factors& f = observation.factors;
  const auto part = [&](SharedBy what, const std::string& key) { return shared_by & what ? key : std::string(); };
  return fmt::format("={}/{}/{}/{}/{}", part(kSameRegion, f.region), part(kSameSession, session_key(observation)),
                     part(kSamePlace, fmt::format("{:g}, {:g}", f.lateral_mm, f.distance_mm)),
                     part(kSameLiquid, f.liquid), part(kSameFill, fmt::format("{:g}", f.fill_mm)));
}

/// Told from how trials scatter, not from rays.
bool is_motion(std::string_view observable) {
  return observable == "desk_waves_px" || observable.ends_with("_motion_mm") || observable.ends_with("_motion_deg") ||
         observable == "desk_wander_mm";
}

Groups groups_of(const ModelError& error, const std::vector<Observation>& observations) {
  return group_by(observations, [&](const Observation& o) {
    return o.observable == error.observable ? shared_key(o, error.shared_by) : std::string();
  });
}

/// Each view of a desk has a bias of its own beside the unit's, smooth over some pixels: of measured desks, predicted
/// from others of the same unit, 35 % of 0.11 px is left, smoothed by a Gaussian of 8 px (docs/calibrate.md). So much
/// of it is in means over thirds of the image, and in a plane that is fitted.
std::vector<SharedError> errors_of_views(const std::vector<Observation>& observations, const LaboratoryRig& rig) {
  constexpr double kBiasOfView_px = 0.35 * 0.11;
  constexpr double kPatch_px2 = 4.0 * std::numbers::pi * 8.0 * 8.0;  // integral of such a field's correlation
  constexpr double kImage_px2 = 640.0 * 480.0;                       // where nothing says how much of it was seen
  std::vector<double> pixels;
  for (const Observation& o : observations)
    if (o.observable == "desk_residual_mm") pixels.push_back(o.pixels > 0.0 ? o.pixels : kImage_px2 / 9.0);
  const auto views = std::count_if(observations.begin(), observations.end(),
                                   [](const Observation& o) { return o.observable == "desk_pitch_deg"; });
  if (pixels.empty() || views == 0) return {};
  constexpr double kFlattest = 0.1;  // sine of a pitch below which the image's middle sees no desk
  const double depth = rig.height_m / std::max(std::sin(rig.pitch_rad), kFlattest);
  const double per_px =
      rig.height_m / (rig.focal_px * rig.baseline_m);  // height above the desk, for each metre of depth
  const double of_view = std::accumulate(pixels.begin(), pixels.end(), 0.0) / static_cast<double>(views);
  const double width = std::sqrt(4.0 / 3.0 * of_view), height = 0.75 * width;  // of what is seen of the desk, in px
  const double slope = per_px * rig.focal_px * kBiasOfView_px * std::sqrt(12.0 * kPatch_px2 / of_view);
  const std::array of_views{std::pair("desk_residual_mm", mm_from_metres(per_px * depth * kBiasOfView_px *
                                                                         std::sqrt(kPatch_px2 / median(pixels)))),
                            std::pair("desk_pitch_deg", deg_from_radians(slope / height)),
                            std::pair("desk_roll_deg", deg_from_radians(slope / width))};
  std::vector<SharedError> errors;
  // A plane that leans stands higher or lower below the camera; all of a session's views of one part of the desk lean
  // alike.
  const double ahead = rig.height_m / std::max(std::tan(rig.pitch_rad), kFlattest);
  Groups parts = group_by(observations, [](const Observation& o) {
    if (o.observable != "desk_height_mm") return std::string();
    return has_cup(o.factors) ? shared_key(o, kSameSession | kSamePlace) : session_key(o);
  });
  if (parts.count > 0)
    errors.push_back({"desk_height_mm", std::move(parts.of), mm_from_metres(ahead * slope / height)});
  for (const auto& [observable, sigma] : of_views) {
    std::vector<int> each;  // a group of its own
    int count = 0;
    for (const Observation& o : observations) each.push_back(o.observable == observable ? count++ : -1);
    errors.push_back({observable, std::move(each), sigma, median(pixels)});
  }
  return errors;
}

}  // namespace

std::vector<SharedError> model_errors(const std::vector<Observation>& observations, const LaboratoryRig& rig) {
  std::vector<SharedError> errors;
  for (const ModelError& error : kModelErrors) {
    Groups groups = groups_of(error, observations);
    if (groups.count == 0) continue;
    const bool is_by_condition = (error.shared_by & kSameCondition) == kSameCondition;
    errors.push_back(
        {std::string(error.observable), std::move(groups.of), error.sigma, error.of_pixels, is_by_condition});
  }
  for (SharedError& error : errors_of_views(observations, rig)) errors.push_back(std::move(error));
  return errors;
}

OwnErrors effect_errors(std::string_view id, const std::vector<Observation>& observations,
                        const std::vector<bool>& sees_through) {
  const auto n = static_cast<Eigen::Index>(observations.size());
  OwnErrors own{Eigen::MatrixXd(n, 0)};
  Eigen::MatrixXd& errors = own.columns;
  for (const EffectError& of_effect : kEffectErrors) {
    if (of_effect.effect != id) continue;
    own.grow_from = of_effect.grows_from;
    const Groups groups = groups_of(of_effect.error, observations);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, groups.count);
    for (Eigen::Index row = 0; row < n; ++row)
      if (groups.of[row] >= 0 && (of_effect.everywhere || sees_through[row]))
        columns(row, groups.of[row]) = of_effect.error.sigma;
    std::vector<Eigen::Index> seen;
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      if (!columns.col(k).isZero(0.0)) seen.push_back(k);
    const auto count = static_cast<Eigen::Index>(seen.size());
    errors.conservativeResize(n, errors.cols() + count);
    errors.rightCols(count) = columns(Eigen::all, seen);
  }
  return own;
}

Eigen::VectorXd numerical_errors(const std::vector<Observation>& observations) {
  // Of few rays against as many as make no difference (tests/diagnosis/predict/surrogate_test.cpp).
  constexpr double kLength_mm = 0.007, kAngle_deg = 0.0005, kShare = 0.02;
  // Which heights of two surfaces, or of waves, a matcher keeps is its own. Those that stray are some 12 mm off: twice
  // the 6 mm from which they do. If it kept those of one side only, a mean would be off by their share of that. It may
  // be more: in photometric frames of waves regions of which 0.13 to 0.23 stray are off by 5 to 6 mm.
  constexpr double kOfStrays_mm = 12.0;
  Eigen::VectorXd errors(static_cast<Eigen::Index>(observations.size()));
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const std::string& name = observations[i].observable;
    const double of_strays = kOfStrays_mm * observations[i].stray_share;
    errors[static_cast<Eigen::Index>(i)] = is_motion(name)          ? 0.0
                                           : name.ends_with("_mm")  ? std::hypot(kLength_mm, of_strays)
                                           : name.ends_with("_deg") ? kAngle_deg
                                                                    : kShare;
  }
  return errors;
}

}  // namespace fathom
