#include "sim/optics/glaze.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "sim/optics/fresnel.h"
#include "sim/optics/phase.h"

namespace fathom {
namespace {

/// ∫ ggx_reflection cos θ dω: the mean weight of the sampler over a grid of its two numbers.
double rough_reflectance(double cosine, double alpha, double n_from, double n_to) {
  constexpr int kSteps = 48;
  const Eigen::Vector3d from(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      if (const auto sample = sample_ggx_reflection(from, alpha, n_from, n_to, (i + 0.5) / kSteps, (j + 0.5) / kSteps))
        sum += sample->weight;
  return sum / (kSteps * kSteps);
}

}  // namespace

Glaze::Glaze(double base_albedo, double roughness, double n_outside, double n_coat)
    : base_albedo_(base_albedo), roughness_(roughness), n_outside_(n_outside), n_coat_(n_coat) {
  assert(base_albedo >= 0.0 && base_albedo <= 1.0);
  constexpr int kNodes = 65;
  constexpr double kGrazing = 1e-6;  // the sampler needs a cosine above 0
  if (roughness_ >= kSmooth)
    for (int i = 0; i < kNodes; ++i) {
      const double root = std::max(static_cast<double>(i) / (kNodes - 1), kGrazing);
      reflectance_.push_back(rough_reflectance(root * root, roughness_, n_outside_, n_coat_));
    }
  constexpr int kSteps = 2000;  // midpoint rule
  mean_transmittance_ = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    mean_transmittance_ += (1.0 - surface_reflectance(cosine)) * 2.0 * cosine / kSteps;
  }
  const double n = n_coat_ / n_outside_;
  const double from_within = 1.0 - mean_transmittance_ / (n * n);
  leaving_ = base_albedo_ * (1.0 - from_within) / (1.0 - base_albedo_ * from_within);
}

double Glaze::surface_reflectance(double cosine) const {
  if (reflectance_.empty()) return fresnel_reflectance(cosine, n_outside_, n_coat_);
  const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * static_cast<double>(reflectance_.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), reflectance_.size() - 2);
  const double share = place - static_cast<double>(below);
  return (1.0 - share) * reflectance_[below] + share * reflectance_[below + 1];
}

double Glaze::diffuse(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  if (from.z() <= 0.0 || to.z() <= 0.0) return 0.0;
  const double in = 1.0 - surface_reflectance(from.z()), out = 1.0 - surface_reflectance(to.z());
  return in * out * leaving_ / (std::numbers::pi * mean_transmittance_);
}

double Glaze::reflection(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const double coat = reflectance_.empty() ? 0.0 : ggx_reflection(from, to, roughness_, n_outside_, n_coat_);
  return coat + diffuse(from, to);
}

double Glaze::albedo(double cosine) const {
  const double reflected = surface_reflectance(cosine);
  return reflected + (1.0 - reflected) * leaving_;
}

std::optional<GgxSample> Glaze::sample(const Eigen::Vector3d& from, Rng& rng) const {
  const double all = albedo(from.z());
  if (all <= 0.0) return std::nullopt;
  const double chance = surface_reflectance(from.z()) / all;
  if (rng.uniform() < chance) {
    const double u1 = rng.uniform(), u2 = rng.uniform();
    std::optional<GgxSample> mirrored = sample_ggx_reflection(from, roughness_, n_outside_, n_coat_, u1, u2);
    if (mirrored) mirrored->weight /= chance;
    return mirrored;
  }
  const Eigen::Vector3d to = sample_diffuse(Eigen::Vector3d::UnitZ(), rng);
  return GgxSample{to, std::numbers::pi * diffuse(from, to) / (1.0 - chance)};
}

}  // namespace fathom
