#include "sim/optics/far_centroid.h"

#include <cassert>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/optics/layers.h"

namespace fathom {
namespace {

/// What light counts at a distance from the centre, and how that changes [1/m].
struct FarWeight {
  double value, slope;
};

FarWeight far_weight(double distance, double transport_path) {
  constexpr double kNear = 2.0, kFar = 5.0;  // transport mean free paths
  const double rise = 0.5 * std::numbers::pi / ((kFar - kNear) * transport_path);
  const double phase = rise * (distance - kNear * transport_path);
  if (phase <= 0.0) return {0.0, 0.0};
  if (phase >= 0.5 * std::numbers::pi) return {1.0, 0.0};
  return {std::sin(phase) * std::sin(phase), rise * std::sin(2.0 * phase)};
}

/// Moments of the light that leaves in one walk, for a centre at (centre, 0).
///
/// A walk whose rest is given half a turn about the vertical through one of its scatterings is a walk too; the phase
/// function alone says how likely either is. So each walk stands for all that half-turns at its first scatterings make
/// of it, each with its share of the weight. Most of the light's spread, many times its shift, cancels.
class HalfTurnedWalks {
 public:
  HalfTurnedWalks(const Turbid& medium, double centre)
      : medium_(medium), centre_(centre, 0.0), transport_path_(1.0 / (medium.scattering * (1.0 - medium.anisotropy))) {}

  void at_scattering(const Walker& walker) {
    if (scatterings_ > 0 && turns_.size() < kMostTurns) add_turn(walker);
    last_ = walker;
    ++scatterings_;
  }

  void leaves(const Walker& walker, const Eigen::Vector3d&, double weight) {
    for (unsigned turned = 0; turned < 1u << turns_.size(); ++turned) {
      Eigen::Vector2d end = walker.position.head<2>();
      double share = weight;
      for (std::size_t i = turns_.size(); i-- > 0;) {  // a turn takes the later ones with it
        const bool turns = turned >> i & 1u;
        if (turns) end = 2.0 * turns_[i].axis - end;
        share *= turns ? turns_[i].share : 1.0 - turns_[i].share;
      }
      const Eigen::Vector2d off = end - centre_;
      const double distance = off.norm();
      const FarWeight far = far_weight(distance, transport_path_);
      moment_ += share * far.value * off.x();
      slope_ += share * (far.value + 0.5 * distance * far.slope);
    }
  }

  double moment() const { return moment_; }  ///< Σ h x [m]
  /// How far the moment falls when the centre moves by a metre, in light that is symmetric about it, where Gauss's
  /// theorem makes ∫ x h ∂R/∂x dA = −∫ (h + ρ h′ / 2) R dA.
  double slope() const { return slope_; }
  std::uint64_t scatterings() const { return scatterings_; }

 private:
  static constexpr std::size_t kMostTurns = 5;
  static constexpr double kLeastShare = 0.05;  ///< a turn that next to never happens is not worth its time

  struct Turn {
    Eigen::Vector2d axis;
    double share;  ///< probability of the turned walk, of it and the other one
  };

  /// At the scattering before `walker`, now that the direction in which it left is known.
  void add_turn(const Walker& walker) {
    const Eigen::Vector3d &in = last_.direction, flight = walker.position - last_.position;
    Eigen::Vector3d out = walker.direction;
    const bool straight = flight.dot(out) > (1.0 - 1e-9) * flight.norm();
    if (!straight) out.z() = -out.z();  // the surface reflected it on the way
    const double as_is = henyey_greenstein(in.dot(out), medium_.anisotropy);
    const Eigen::Vector3d turned_out(-out.x(), -out.y(), out.z());
    const double turned = henyey_greenstein(in.dot(turned_out), medium_.anisotropy);
    const double share = turned / (as_is + turned);
    if (share > kLeastShare && share < 1.0 - kLeastShare) turns_.push_back({last_.position.head<2>(), share});
  }

  Turbid medium_;
  Eigen::Vector2d centre_;
  double transport_path_;
  Walker last_{};
  std::vector<Turn> turns_;
  std::uint64_t scatterings_ = 0;
  double moment_ = 0.0, slope_ = 0.0;
};

}  // namespace

Estimate far_centroid(const Turbid& medium, double angle, std::uint64_t seed, const SamplingPlan& plan) {
  assert(medium.scattering > 0.0 && medium.absorption > 0.0 && angle > 0.0 && angle < 0.5 * std::numbers::pi);
  const LayerSpace space({{medium, std::numeric_limits<double>::infinity()}});
  const Eigen::Vector3d beam(std::sin(angle), 0.0, -std::cos(angle));
  const Walker start{Eigen::Vector3d::Zero(), *refract(beam, Eigen::Vector3d::UnitZ(), 1.0, medium.n), 1.0, 0};
  const auto moments_about = [&](double centre, std::uint64_t stream, const SamplingPlan& samples) {
    return sample_until(samples, 2,
                        [&](std::uint64_t number, std::span<double> quantities) {
                          Rng rng(seed, stream, number);
                          HalfTurnedWalks walks(medium, centre);
                          random_walk_of_beam(space, start, rng, walks);
                          quantities[0] = walks.moment(), quantities[1] = walks.slope();
                          return 1 + walks.scatterings();
                        })
        .quantities;
  };
  // Newton's method: what the first step leaves of the moment is small against its error after the second.
  SamplingPlan rough;
  rough.samples = 16'384;
  const std::vector<Estimate> first = moments_about(0.0, 1, rough);
  const double centre = first[0].value / first[1].value;
  SamplingPlan fine = plan;
  fine.judged = 1;
  constexpr double kMargin = 0.97;  // the rough moments are good to a few per cent
  fine.absolute_error = kMargin * plan.relative_error * centre * first[1].value;
  const std::vector<Estimate> second = moments_about(centre, 2, fine);
  return {centre + second[0].value / second[1].value, second[0].standard_error / second[1].value};
}

}  // namespace fathom
