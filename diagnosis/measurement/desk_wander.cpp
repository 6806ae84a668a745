#include "diagnosis/measurement/desk_wander.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.h"

namespace fathom {
namespace {

constexpr std::size_t kParts = 3;      // of a campaign: one session is cut into as many
constexpr std::size_t kFewest = 4;     // placements in each
constexpr double kUnexplained = 0.25;  // of the variance that local noise makes: noise reaches across borders

/// Variance of the height of a plane that is fitted to nine thirds of the image, over the mean variance that is left in
/// them, when their errors are independent and equal.
double height_over_residual(const LaboratoryRig& rig) {
  constexpr double kThird_px = 640.0 / 3.0, kThirdRow_px = 160.0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (int row = -1; row <= 1; ++row)
    for (int column = -1; column <= 1; ++column) {
      // Where that line of sight meets the desk, from the camera's foot [m].
      const double u = column * kThird_px / rig.focal_px, v = row * kThirdRow_px / rig.focal_px;
      const double down = std::sin(rig.pitch_rad) + v * std::cos(rig.pitch_rad);
      const double ahead = std::cos(rig.pitch_rad) - v * std::sin(rig.pitch_rad);
      const double z = rig.height_m / std::max(down, 0.1);
      const Eigen::Vector3d at(1.0, z * u, z * ahead);
      normal += at * at.transpose();
    }
  constexpr double kLeft = (9.0 - 3.0) / 9.0;  // of the variance, once the plane is taken off
  return normal.ldlt().solve(Eigen::Vector3d::UnitX()).x() / kLeft;
}

/// Variances between the trials of one placement [mm²].
struct Scatter {
  double time_s = 0.0, height = 0.0, residuals = 0.0;
  int thirds = 0;
};

Observation wander_of(int session, std::vector<Scatter>::const_iterator first,
                      std::vector<Scatter>::const_iterator last, double ratio) {
  const auto n = static_cast<double>(last - first);
  double excess = 0.0, local = 0.0, squares = 0.0;
  for (auto s = first; s != last; ++s) {
    const double own = ratio * s->residuals / s->thirds;
    excess += (s->height - own) / n;
    local += own / n;
  }
  for (auto s = first; s != last; ++s) squares += std::pow(s->height - ratio * s->residuals / s->thirds - excess, 2);
  const double error = std::hypot(std::sqrt(squares / (n * (n - 1.0))), kUnexplained * local);
  Observation wander;
  wander.observable = "desk_wander_mm";
  wander.factors.session = session;
  wander.factors.liquid = "none";
  wander.factors.region = "desk";
  wander.value = std::copysign(std::sqrt(std::abs(excess)), excess);
  // As significant as the excess is, and never less uncertain than the root of its error.
  const double of_root = std::min(std::sqrt(error), error / std::max(std::abs(wander.value), 1e-12));
  wander.repeats = static_cast<int>(n);
  wander.repeat_sd = of_root * std::sqrt(n);
  return wander;
}

}  // namespace

std::vector<Observation> desk_wander(const std::vector<Observation>& observations, const LaboratoryRig& rig) {
  std::map<int, std::map<std::pair<int, double>, Scatter>> sessions;
  for (const Observation& o : observations) {
    if (o.repeats < 2) continue;
    const bool is_height = o.observable == "desk_height_mm";
    if (!is_height && o.observable != "desk_residual_mm") continue;
    Scatter& scatter = sessions[o.factors.session][{o.factors.placement, o.factors.time_s}];
    scatter.time_s = o.factors.time_s;
    (is_height ? scatter.height : scatter.residuals) += o.repeat_sd * o.repeat_sd;
    scatter.thirds += !is_height;
  }
  std::vector<Observation> result;
  const std::size_t parts = sessions.size() < kParts ? kParts / std::max<std::size_t>(sessions.size(), 1) : 1;
  for (const auto& [session, placements] : sessions) {
    std::vector<Scatter> in_time;
    for (const auto& [key, scatter] : placements)
      if (scatter.thirds > 0 && scatter.residuals > 0.0) in_time.push_back(scatter);
    if (in_time.size() < parts * kFewest) continue;
    std::stable_sort(in_time.begin(), in_time.end(),
                     [](const Scatter& a, const Scatter& b) { return a.time_s < b.time_s; });
    for (std::size_t part = 0; part < parts; ++part) {
      const auto at = [&](std::size_t k) {
        return in_time.begin() + static_cast<std::ptrdiff_t>(in_time.size() * k / parts);
      };
      result.push_back(wander_of(session, at(part), at(part + 1), height_over_residual(rig)));
    }
  }
  return result;
}

}  // namespace fathom
