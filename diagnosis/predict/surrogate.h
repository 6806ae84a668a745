// What a frame of a set-up says in the mean, by some hundred exact rays instead of a picture.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "diagnosis/measurement/unit_bias.h"
#include "diagnosis/predict/cup_optics.h"
#include "diagnosis/predict/device_reader.h"

namespace fathom {

inline constexpr int kDeskColumns = 24, kDeskRows = 18;  ///< raster of the desk's pixels

/// Pixels of the depth image that stand for it; fixed by what the laboratory believes, so that set-ups that differ a
/// little are looked at by the same rays. Of a cup more than 3 mm beside its place others of the same raster are.
struct SampledPixels {
  std::vector<Eigen::Vector2d> desk, cup, walls;
  double desk_weight = 0.0, cup_weight = 0.0, wall_weight = 0.0;  ///< pixels that each stands for
  FrameView view;                                                 ///< as soft as the cup's are apart on the desk
};

/// `written` as the laboratory looks at its clouds.
SampledPixels sample_pixels(const LaboratoryRig& rig, const FrameView& written);

/// All of a set-up that its points depend on.
struct SurrogateView {
  DeviceReader reader;
  double desk_albedo, bisector, step_phase;
  std::optional<CupOptics> cup;
};

struct SurrogateFrame {
  SurrogateView view;
  std::vector<SensedPoint> desk, inside, walls;  ///< as the device gives them
  std::optional<FrameEstimates> estimates;       ///< of all of them; nothing when no desk is seen
  bool is_known = false;                         ///< the same as the known frame
};

SurrogateView surrogate_view(const Setup& setup);

/// Natural logarithm of the contrast that infrared dots have in the cup, over that on the desk: 0 but for liquids that
/// let light in before they scatter it back (dot_contrast).
double log_contrast_of_dots(const Setup& setup);

/// What the laboratory would find in such a frame: direct light, triangulated exactly, read by the device with its
/// calibration, its law's mean and its unit's error without wander; then the measurement's own estimators.
/// Not predicted: noise and so spreads, what the matcher loses, interreflections (intensities are of direct
/// light). Of waves the mean over phases and directions is predicted, through water as windows read it that span a
/// wave. Combs are those of even mixtures of steps. What looks the same in a `known` frame of these pixels is taken
/// from there. Throws Error for a clear cup or one of a glTF file.
SurrogateFrame surrogate_frame(const Setup& setup, const LaboratoryRig& rig, const SampledPixels& pixels,
                               const SurrogateFrame* known = nullptr);

/// The same without estimates, unless they are known.
SurrogateFrame surrogate_points(const Setup& setup, const LaboratoryRig& rig, const SampledPixels& pixels,
                                const SurrogateFrame* known);

/// What the laboratory would find in a frame once these biases are taken off it, one after the other.
std::optional<FrameEstimates> estimates_without(std::span<const Bias> biases, const SurrogateFrame& frame,
                                                const LaboratoryRig& rig, const SampledPixels& pixels);

/// Whether two set-ups' desks are read alike.
bool desk_looks_alike(const SurrogateView& a, const SurrogateView& b);

/// What single shots through waves on a clear liquid show, and their mean does not.
struct UnderWaves {
  double scatter_mm = 0.0;  ///< by how much the height of a region differs between shots, 1 σ
  /// Of every region of the cup: of a shot's heights, those that are too far from their median to count.
  std::array<double, 5> stray_share{};
};
/// Nothing without waves.
std::optional<UnderWaves> under_waves(const Setup& setup, const LaboratoryRig& rig, const SampledPixels& pixels);

/// Of every region of the cup the share that lies in a shadow, or behind the rim, or within a matcher's reach of
/// either: what is measured there is decided by windows that hold two surfaces, which no ray tells of.
std::array<double, 5> shares_near_shadows(const SurrogateFrame& frame, const LaboratoryRig& rig,
                                          const SampledPixels& pixels);
/// The same of the cells of its raster.
std::array<double, kCupCells> cells_near_shadows(const SurrogateFrame& frame, const LaboratoryRig& rig,
                                                 const SampledPixels& pixels);

}  // namespace fathom
