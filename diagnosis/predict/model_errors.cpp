#include "diagnosis/predict/model_errors.h"

#include <fmt/format.h>

#include <array>
#include <map>

namespace fathom {
namespace {

/// Which observations have the same error of the model, beside being of one observable and region.
enum class SharedBy { all, session, place, liquid, condition };

/// What few rays and direct light leave out of an observable (see surrogate.h and its test).
struct ModelError {
  std::string_view observable;
  double sigma;
  SharedBy shared_by;
};
constexpr std::array kModelErrors{
    ModelError{"height_mm", 0.05, SharedBy::liquid},      // against whole frames
    ModelError{"height_mm", 0.10, SharedBy::condition},   // matching: the same dots fall the same way each time
    ModelError{"desk_height_mm", 0.05, SharedBy::all},    // against whole frames, as the next two
    ModelError{"desk_height_mm", 0.10, SharedBy::place},  // a cup hides what the plane was fitted to
    ModelError{"desk_pitch_deg", 0.02, SharedBy::all},       ModelError{"desk_roll_deg", 0.02, SharedBy::all},
    ModelError{"desk_residual_mm", 0.10, SharedBy::all},      // a matcher's bias by place; a Kinect has -0.3 to 0.7 mm
    ModelError{"desk_residual_mm", 0.10, SharedBy::session},  // the same, as the dots fall that day
    ModelError{"comb_strength", 0.10, SharedBy::session},     // depths are no even mixture of steps
    ModelError{"millimetre_comb", 0.02, SharedBy::all}};

std::string shared_key(const Factors& f, SharedBy shared_by) {
  std::string key = f.region;
  if (shared_by == SharedBy::session) return key + fmt::format(", session {}", f.session);
  if (shared_by == SharedBy::place) return key + fmt::format(", cup at ({:g}, {:g}) mm", f.lateral_mm, f.distance_mm);
  if (shared_by != SharedBy::all) key += " of " + f.liquid;
  if (shared_by == SharedBy::condition)
    key += fmt::format(", {:g} mm, at ({:g}, {:g}) mm", f.fill_mm, f.lateral_mm, f.distance_mm);
  return key;
}

}  // namespace

std::vector<Nuisance> model_errors(const std::vector<Observation>& observations) {
  std::vector<Nuisance> nuisances;
  for (const ModelError& error : kModelErrors) {
    std::map<std::string, Eigen::VectorXd> rows;
    for (std::size_t row = 0; row < observations.size(); ++row) {
      const Observation& o = observations[row];
      if (o.observable != error.observable) continue;
      Eigen::VectorXd& own = rows[shared_key(o.factors, error.shared_by)];
      if (own.size() == 0) own = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observations.size()));
      own[static_cast<Eigen::Index>(row)] = 1.0;
    }
    for (auto& [name, signature] : rows)
      nuisances.push_back(
          {"model of " + std::string(error.observable) + ", " + name, error.sigma, std::move(signature)});
  }
  return nuisances;
}

Eigen::VectorXd numerical_errors(const std::vector<Observation>& observations) {
  constexpr double kLength_mm = 0.05, kAngle_deg = 0.003, kShare = 0.02;
  Eigen::VectorXd errors(static_cast<Eigen::Index>(observations.size()));
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const std::string& name = observations[i].observable;
    errors[static_cast<Eigen::Index>(i)] = name.ends_with("_mm")    ? kLength_mm
                                           : name.ends_with("_deg") ? kAngle_deg
                                                                    : kShare;
  }
  return errors;
}

}  // namespace fathom
