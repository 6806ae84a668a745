// Effects of the sensor: where it stands, its calibration, its matching.
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "sim/effects/changes.h"
#include "sim/effects/effects.h"

namespace fathom::effects {
namespace {

constexpr double kCodePx = 0.125;

}  // namespace

std::vector<Effect> sensor_effects() {
  return {
      {.id = "sensor_height",
       .sentence = "The sensor stands higher above the desk than was measured.",
       .more = "the sensor stands {} higher than was measured",
       .less = "the sensor stands {} lower than was measured",
       .parameters = {{"height_mm", "added to the sensor's height", 0.0, 1.0, -50.0, 50.0}},
       .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: exterior orientation in the error budget",
       .confounded = {"cup_bottom_height", "sensor_pitch"},
       .discriminated_by = "bare-desk views: the fitted desk lies lower",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             setup.rig.world_from_camera.translation().z() += metres_from_mm(setting.values[0]);
           }},
      {.id = "sensor_pitch",
       .sentence = "The sensor looks further down than was measured.",
       .more = "the sensor looks {} further down than was measured",
       .less = "the sensor looks {} less far down than was measured",
       .parameters = {{"pitch_deg", "added to the angle below the horizontal", 0.0, 0.1, -5.0, 5.0}},
       .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: exterior orientation in the error budget",
       .confounded = {"sensor_height", "principal_point"},
       .discriminated_by = "bare-desk views: the fitted desk is pitched",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             const Eigen::AngleAxisd down(-radians_from_deg(setting.values[0]), Eigen::Vector3d::UnitX());
             turn_camera(setup.rig, down.toRotationMatrix());
           }},
      {.id = "sensor_roll",
       .sentence = "The sensor is turned about its line of sight.",
       .more = "the sensor is turned clockwise by {} about its line of sight",
       .less = "the sensor is turned anticlockwise by {} about its line of sight",
       .parameters = {{"roll_deg", "added to the roll, clockwise", 0.0, 0.1, -5.0, 5.0}},
       .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: exterior orientation in the error budget",
       .confounded = {"surface_tilt"},
       .discriminated_by = "bare-desk views: the fitted desk is rolled",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             const Eigen::Vector3d sight = setup.rig.world_from_camera.linear().col(2);
             turn_camera(setup.rig, Eigen::AngleAxisd(radians_from_deg(setting.values[0]), sight).toRotationMatrix());
           }},
      {.id = "baseline",
       .sentence = "Camera and projector stand farther apart than the device assumes.",
       .more = "camera and projector stand {} farther apart than the device assumes",
       .less = "camera and projector stand {} nearer together than the device assumes",
       .parameters = {{"baseline_mm", "added to the baseline", 0.0, 0.1, -5.0, 5.0}},
       .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: baseline among the calibration parameters",
       .confounded = {"focal_length", "disparity_offset"},
       .discriminated_by = "other distances of the desk: an error of scale vanishes at the reference plane",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             const double more = metres_from_mm(setting.values[0]);
             keep_calibration(setup.rig.sensor);
             setup.rig.sensor.baseline += more;
             setup.rig.world_from_camera.translation() -= 0.5 * more * setup.rig.world_from_camera.linear().col(0);
           }},
      {.id = "focal_length",
       .sentence = "The camera's focal length is longer than the device assumes.",
       .more = "the camera's focal length is {} longer than the device assumes",
       .less = "the camera's focal length is {} shorter than the device assumes",
       .parameters = {{"focal_px", "added to the focal length at 640 x 480", 0.0, 1.0, -30.0, 30.0}},
       .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: focal length among the calibration parameters",
       .confounded = {"baseline", "disparity_offset"},
       .discriminated_by = "a gauge of known width across the image: only the focal length scales it",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             keep_calibration(setup.rig.sensor);
             setup.rig.sensor.focal_px += setting.values[0];
           }},
      {.id = "principal_point",
       .sentence = "The optical axis meets the image elsewhere than the device assumes.",
       .parameters = {{"x_px", "to the right", 0.0, 2.0, -20.0, 20.0}, {"y_px", "downward", 0.0, 2.0, -20.0, 20.0}},
       .citation = "Khoshelham & Elberink 2012, Sensors 12, 1437: principal point among the calibration parameters",
       .confounded = {"sensor_pitch", "sensor_roll"},
       .discriminated_by = "a target of known places on the desk",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             keep_calibration(setup.rig.sensor);
             setup.rig.sensor.principal_px += Eigen::Vector2d(setting.values[0], setting.values[1]);
           }},
      {.id = "disparity_offset",
       .sentence = "The device reads all disparities too large by the same amount.",
       .more = "the device reads all disparities {} too large",
       .less = "the device reads all disparities {} too small",
       .parameters = {{"offset_px", "added to every disparity", 0.0, 0.1, -3.0, 3.0}},
       .citation =
           "Khoshelham & Elberink 2012, Sensors 12, 1437: the linear normalisation of the raw disparity has an offset",
       .confounded = {"baseline", "focal_length", "sensor_height", "thermal_drift"},
       .discriminated_by = "other heights of the sensor above the bare desk",
       .apply = [](Setup& setup,
                   const EffectSetting& setting) { setup.rig.sensor.unit.disparity_offset_px += setting.values[0]; }},
      {.id = "radial_distortion",
       .sentence = "The camera's lens bends straight lines, and the device does not know.",
       .parameters = {{"k1", "of Brown's model, over the focal length", 0.0, 0.01, -0.15, 0.15}},
       .citation = "Brown 1966, Photogrammetric Engineering 32, 444",
       .confounded = {"principal_point"},
       .discriminated_by = "the residual of the bare desk by image region",
       .apply = [](Setup& setup,
                   const EffectSetting& setting) { setup.rig.sensor.optics.camera_k1 += setting.values[0]; }},
      {.id = "depth_quantization",
       .sentence = "Depths come in steps of disparity, of 1/8 px or coarser, and are cut to whole millimetres.",
       .parameters = {{"law", "1: the device's law, 0: none", 0.0, 1.0, 0.0, 1.0, {}, 1.0},
                      {"step_px", "of disparity: whole eighths", kCodePx, 3.0 * kCodePx, kCodePx, 1.0, {}, kCodePx}},
       .citation = "OpenNI's shift-to-depth table; the law holds for every point of recorded frames",
       .confounded = {"disparity_offset"},
       .discriminated_by = "the comb of the fractional disparities of any cloud",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             if (setting.values[0] >= 0.5) setup.rig.sensor.law.quantized = true;
             setup.rig.sensor.law.codes_per_step = std::max(setup.rig.sensor.law.codes_per_step,
                                                            static_cast<int>(std::lround(setting.values[1] / kCodePx)));
           }},
      {.id = "thermal_drift",
       .sentence = "The sensor warms up: its disparities start too large and settle.",
       .more = "the sensor's disparities start {} larger than they settle, as it warms up",
       .less = "the sensor's disparities start {} smaller than they settle, as it warms up",
       .parameters = {{"start_px", "too much when the session begins", 0.0, 0.1, -3.0, 3.0},
                      {"settled_px", "too much ever after: the rig was measured before the sensor was warm", 0.0, 0.1,
                       -3.0, 3.0},
                      {"settling_s", "time in which the first falls to 1/e, unless the rig's unit says it", 940.0,
                       200.0, 200.0, 4000.0}},
       .citation = "one Kinect v1, measured: 8 mm in 6 min at 2.5 m; unit_model.h",
       .confounded = {"disparity_offset", "evaporation"},
       .discriminated_by = "the same bare desk at the beginning and the end of a session",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             UnitModel& unit = setup.rig.sensor.unit;
             if (unit.warm_up_px == 0.0) unit.warm_up_s = setting.values[2];
             unit.warm_up_px += setting.values[0];
             unit.on_for_s = setup.circumstances.time_s;
             unit.disparity_offset_px += setting.values[1];
           },
       .of_time = true},
      {.id = "depth_wander",
       .sentence = "All disparities of a frame share an error that is another one in the next frame.",
       .more = "all disparities of a frame share an error of {}, another one in the next frame",
       .parameters = {{"sd_px", "standard deviation of the error", 0.0, 0.05, 0.0, 1.0}},
       .citation = "an empty pot's floor over three Kinect scenes: 0.6 mm where independent points would give 0.04 mm",
       .confounded = {"thermal_drift"},
       .discriminated_by = "many trials without touching anything: the desk itself moves from frame to frame",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             UnitModel& unit = setup.rig.sensor.unit;
             unit.wander_px = std::hypot(unit.wander_px, setting.values[0]);
             unit.on_for_s = setup.circumstances.time_s;
           },
       .of_time = true},
      {.id = "depth_step_phase",
       .sentence = "The steps of depth stand between those of the table that is taken for right.",
       .parameters = {{"phase_steps", "added to where depths lie between whole codes", 0.0, 0.5, 0.0, 1.0}},
       .citation = "two tables are in use, half a step apart: libfreenect and OpenNI, and the vendor's SDK",
       .confounded = {"disparity_offset"},
       .discriminated_by = "the comb of the fractional disparities of any cloud",
       .apply = [](Setup& setup,
                   const EffectSetting& setting) { setup.rig.sensor.law.step_phase += setting.values[0]; }},
      {.id = "depth_truncation",
       .sentence = "Depths are cut to whole millimetres, so all read short by half of one.",
       .parameters = {{"cut", "1: to whole millimetres, 0: not", 0.0, 1.0, 0.0, 1.0, {}, 1.0}},
       .citation = "OpenNI's shift-to-depth table holds whole millimetres",
       .confounded = {"disparity_offset", "sensor_height"},
       .discriminated_by = "the comb of the depths themselves",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             if (setting.values[0] >= 0.5) setup.rig.sensor.law.cut = kMetresPerMm;
           }},
      {.id = "noise_correlation",
       .sentence = "Neighbouring pixels share the light of their blocks, so that their errors are alike.",
       .parameters = {{"wider_px", "added to the width of the blocks", 0.0, 8.0, 0.0, 22.0}},
       .citation = "PrimeSense's blocks of 9 x 9 pixels; errors of measured desks go together over 8 px along rows",
       .confounded = {"window_averaging"},
       .discriminated_by = "the correlation of what a bare desk leaves of its plane",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             MatcherModel& matcher = setup.rig.sensor.matcher;
             const int more = 2 * static_cast<int>(std::lround(0.5 * setting.values[0]));
             matcher.window_columns += more;
             matcher.window_rows += more;
           }},
      {.id = "reference_residue",
       .sentence = "The sensor remembers its reference plane displaced, by another amount in every part of the image.",
       .parameters = {{"sd_px", "standard deviation over the image, of disparity", 0.0, 0.05, 0.0, 1.0}},
       .citation = "what nine measured desks have in common beside their planes: 0.68 steps of 1/8 px over 70 px",
       .confounded = {"radial_distortion"},
       .discriminated_by = "the residual of the bare desk by image region",
       .apply =
           [](Setup& setup, const EffectSetting& setting) {
             double& residue_px = setup.rig.sensor.unit.residue_px;
             residue_px = std::hypot(residue_px, setting.values[0]);
           }},
  };
}

}  // namespace fathom::effects
