#include "trials/trial_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sim/sensor/preview.h"

namespace fathom {
namespace {

constexpr Rgb kFound{0, 220, 90}, kMissed{255, 40, 40}, kTaken{60, 150, 255};

/// Paints into the infrared and the depth panel.
class UpperPanels {
 public:
  UpperPanels(Image<Rgb>& picture, int width, int height) : picture_(picture), width_(width), height_(height) {}

  void paint(int x, int y, const Rgb& colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    picture_(x, y) = picture_(width_ + x, y) = colour;
  }

 private:
  Image<Rgb>& picture_;
  int width_, height_;
};

/// Of each object of the geometry the cup that it is part of, or −1.
std::vector<int> cup_of_objects(const TrialShot& shot) {
  std::vector<int> cups{-1};  // object 0 is nothing
  for (const std::string& name : shot.camera.geometry().objects) {
    int cup = static_cast<int>(shot.setup.scene.cups.size()) - 1;
    while (cup >= 0 && !name.starts_with(fmt::format("cup {} ", cup))) --cup;
    cups.push_back(cup);
  }
  return cups;
}

void outline_cups(const TrialShot& shot, const TrialResult& result, UpperPanels& panels) {
  const std::vector<int> cups = cup_of_objects(shot);
  const Image<TruePixel>& truth = shot.camera.truth();
  const auto cup_at = [&](int x, int y) { return cups[truth(x, y).object]; };
  for (int y = 0; y + 1 < truth.height(); ++y)
    for (int x = 0; x + 1 < truth.width(); ++x) {
      const int here = cup_at(x, y);
      for (const int beside : {cup_at(x + 1, y), cup_at(x, y + 1)})
        if (here != beside) panels.paint(x, y, result.cups[std::max(here, beside)].found ? kFound : kMissed);
    }
}

void draw_circle(const TrialShot& shot, const Eigen::Isometry3d& camera_from_desk, const Circle& circle,
                 double height_m, UpperPanels& panels) {
  const SensorModel& sensor = shot.setup.rig.sensor;
  constexpr int kSteps = 720;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSteps;
    const Eigen::Vector2d at = circle.center + circle.radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector3d in_camera = camera_from_desk * Eigen::Vector3d(at.x(), at.y(), height_m);
    if (!(in_camera.z() > 0.0)) continue;
    const Eigen::Vector2d px = sensor.focal_px * in_camera.head<2>() / in_camera.z() + sensor.principal_px;
    panels.paint(static_cast<int>(std::floor(px.x())), static_cast<int>(std::floor(px.y())), kTaken);
  }
}

}  // namespace

Image<Rgb> trial_picture(const TrialShot& shot, const Trial& trial) {
  Image<Rgb> picture = preview(shot.frame, shot.camera.truth());
  UpperPanels panels(picture, shot.camera.truth().width(), shot.camera.truth().height());
  outline_cups(shot, trial.result, panels);
  if (!trial.detection.desk) return picture;
  const Eigen::Isometry3d camera_from_desk = desk_from_camera(trial.detection.desk->plane).inverse();
  constexpr double kBand = 0.045;  // m, where circles are told
  for (const DetectedCup& cup : trial.detection.cups)
    for (const double height : {kBand, cup.candidate.top_m})
      draw_circle(shot, camera_from_desk, *cup.candidate.circle, height, panels);
  return picture;
}

}  // namespace fathom
