// The bias of disparity that a campaign's own sensor has over its image, learned from the desk in all of its clouds.
#pragma once

#include <functional>
#include <map>
#include <optional>

#include "diagnosis/measurement/desk_cells.h"
#include "diagnosis/unit/bias_learner.h"
#include "diagnosis/unit/calibration_view.h"
#include "diagnosis/unit/desk_difference.h"
#include "diagnosis/unit/local_bias.h"

namespace fathom {

/// An error of disparity over the image [px].
using Bias = std::function<double(const BiasPoint&)>;

/// How far a model's desk is off its plane at a cell [px]; nothing where it shows none.
using DeskError = std::function<std::optional<double>(const BiasCell& cell)>;

/// Share of a Kinect's bias that is left on a desk when other desks were learned from (docs/calibrate.md).
inline constexpr double kLeftByCalibration = 0.45;

class UnitBias {
 public:
  /// A cloud's errors are those about its own plane. Where clouds are cut out around the cup, these planes lean with
  /// the bias in their part of the image, so that every scene counts as a view whose plane is not known. Within a
  /// session sensor and desk stay where they are, and the same dots fall on the same places: the scenes of a session
  /// that show a cell together say no more of it than one. `is_calibrated`: what fathom calibrate found of the unit was
  /// taken off before.
  explicit UnitBias(const Desks& desks, bool is_calibrated = false);

  /// Without the plane that is nearest to it: of a plane nobody can say whether it is bias or pose.
  const BiasField& field() const { return field_; }
  /// What would be learned from a model's desks, given by session: the same operator. The first one's stands for
  /// sessions that it lacks.
  BiasField learn(const std::map<int, DeskError>& desks) const;

  /// Where sessions read their desk otherwise than the others, of one desk in all.
  std::vector<DeskDifference> session_differences() const;

  /// Where the unit reads otherwise than its bias elsewhere lets expect.
  std::optional<LocalBias> local_bias() const { return most_local_bias(learner_, views_.views); }

  /// What would be known, were the whole desk seen bare in every session.
  UnitBias with_bare_desks() const;

  /// 1 σ [px] of what is not known of the bias there.
  double sigma(const BiasPoint& point) const { return learner_.sigma(point); }
  /// What is not known as independent patterns of 1 σ: the planes that a bias like this has, and of the rest those
  /// `count` that matter most for these points.
  std::vector<Bias> error_modes(int count, std::span<const BiasPoint> where) const;

 private:
  struct Views {
    std::vector<int> sessions;
    std::vector<BiasView> views;          ///< whose cells count by how well they are known beside those of other scenes
    std::map<int, BiasView> of_sessions;  ///< all scenes of each together
    BiasPrior prior;
    double weight_of_one = 1.0;  ///< of a cell that only one placement shows
  };
  static Views views_of(const Desks& desks, bool is_calibrated);
  explicit UnitBias(Views views);

  Views views_;
  BiasLearner learner_;
  BiasField field_;
};

/// Of a field, which must outlive it.
Bias as_bias(const BiasField& field);

/// What fathom calibrate found; the map must outlive it.
Bias as_bias(const UnitMap& map);

/// Where a point is seen and how near, as fields take it.
BiasPoint bias_point(const Eigen::Vector3f& point, const DeviceScale& scale);
BiasPoint bias_point(const Eigen::Vector3f& point, const LaboratoryRig& rig);

/// How many times as far a point of depth `z` is without this bias, where disparities are `of_inverse` / z [px]; 1
/// where nothing would be seen.
float stretch_without(const Bias& bias, const BiasPoint& point, double of_inverse, double z);

/// Points moved along their lines of sight to where they would be read without this bias. What the device gave stays
/// known (SensedPoint::device_z).
void take_off(const Bias& bias, const LaboratoryRig& rig, std::span<SensedPoint> points);

}  // namespace fathom
