#include "trials/trial_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fathom {
namespace {

constexpr Rgb kFound{0, 220, 90}, kMissed{255, 40, 40}, kTaken{60, 150, 255};

/// Paints the same pixel of every panel.
class Panels {
 public:
  Panels(Image<Rgb>& picture, int width, int height, int count)
      : picture_(picture), width_(width), height_(height), count_(count) {}

  void paint(int x, int y, const Rgb& colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    for (int panel = 0; panel < count_; ++panel) picture_(panel * width_ + x, y) = colour;
  }

 private:
  Image<Rgb>& picture_;
  int width_, height_, count_;
};

void outline_cups(const LabelledFrame& frame, const TrialResult& result, Panels& panels) {
  const int cups = static_cast<int>(frame.cups.size());
  const auto cup_at = [&](int x, int y) {
    const int owner = frame.owners(x, y);
    return owner < cups ? owner : LabelledFrame::kNobody;
  };
  for (int y = 0; y + 1 < frame.owners.height(); ++y)
    for (int x = 0; x + 1 < frame.owners.width(); ++x) {
      const int here = cup_at(x, y);
      for (const int beside : {cup_at(x + 1, y), cup_at(x, y + 1)})
        if (here != beside) panels.paint(x, y, result.cups[std::max(here, beside)].found ? kFound : kMissed);
    }
}

void draw_circle(const LabelledFrame& frame, const Eigen::Isometry3d& camera_from_desk, const Circle& circle,
                 double height_m, Panels& panels) {
  constexpr int kSteps = 720;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSteps;
    const Eigen::Vector2d at = circle.center + circle.radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector3d in_camera = camera_from_desk * Eigen::Vector3d(at.x(), at.y(), height_m);
    if (!(in_camera.z() > 0.0)) continue;
    const Eigen::Vector2d px = frame.focal_px * in_camera.head<2>() / in_camera.z() + frame.principal_px;
    panels.paint(static_cast<int>(std::floor(px.x())), static_cast<int>(std::floor(px.y())), kTaken);
  }
}

}  // namespace

void draw_trial(const LabelledFrame& frame, const Trial& trial, int panels_across, Image<Rgb>& picture) {
  Panels panels(picture, frame.owners.width(), frame.owners.height(), panels_across);
  outline_cups(frame, trial.result, panels);
  if (!trial.detection.desk) return;
  const Eigen::Isometry3d camera_from_desk = desk_from_camera(trial.detection.desk->plane).inverse();
  constexpr double kBand = 0.045;  // m, where circles are told
  for (const DetectedCup& cup : trial.detection.cups)
    for (const double height : {kBand, cup.candidate.top_m})
      draw_circle(frame, camera_from_desk, *cup.candidate.circle, height, panels);
}

}  // namespace fathom
