#include "sim/optics/layer_light.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <optional>

#include "core/error.h"

namespace fathom {
namespace {

constexpr std::uint64_t kStream = 0x6c6179657273ULL;

/// What became of one walk.
struct Tally {
  const LayerSpace* space;
  double up = 0.0, down = 0.0, absorbed = 0.0;
  std::uint64_t scatterings = 0;

  void leaves(const Walker&, const Eigen::Vector3d& normal, double weight) { (normal.z() < 0.0 ? up : down) += weight; }
  /// Of the light that meets a particle or absorber, μs of μs + μa is scattered: each scattering stands for μa / μs
  /// of its weight that is absorbed.
  void at_scattering(const Walker& walker) {
    const Turbid& medium = space->medium(walker);
    absorbed += walker.weight * medium.absorption / medium.scattering;
    ++scatterings;
  }
};

bool gives_all_back(const std::vector<Layer>& layers) {
  const Layer& lowest = layers.back();
  if (std::isfinite(lowest.thickness) || lowest.medium.scattering == 0.0 || lowest.medium.absorption > 0.0)
    return false;
  for (const Layer& layer : layers)
    if (layer.medium.absorption > 0.0)
      throw Error("the lowest layer",
                  "must absorb when it is infinitely thick and scatters, and another layer absorbs");
  return true;
}

}  // namespace

LayerLight light_in_layers(const LayerSpace& space, double angle, std::uint64_t seed, const SamplingPlan& plan) {
  assert(angle >= 0.0 && angle < 0.5 * std::numbers::pi);
  const double n_first = space.layers().front().medium.n;
  LayerLight light;
  light.specular = fresnel_reflectance(std::cos(angle), 1.0, n_first);
  const Eigen::Vector3d beam(std::sin(angle), 0.0, -std::cos(angle));
  const std::optional<Eigen::Vector3d> inside = refract(beam, Eigen::Vector3d::UnitZ(), 1.0, n_first);
  if (!inside || light.specular >= 1.0 || gives_all_back(space.layers())) {
    light.reflectance.value = 1.0;
    light.absorptance = Estimate{};
    return light;
  }
  const Walker start{Eigen::Vector3d::Zero(), *inside, 1.0 - light.specular, 0};
  const auto walk = [&](std::uint64_t number, std::span<double> quantities) {
    Rng rng(seed, kStream, number);
    Tally tally{.space = &space};
    random_walk_of_beam(space, start, rng, tally);
    quantities[0] = light.specular + tally.up, quantities[1] = tally.down, quantities[2] = tally.absorbed;
    return 1 + tally.scatterings;
  };
  const Layer& lowest = space.layers().back();
  const bool swallows =
      std::isinf(lowest.thickness) && (lowest.medium.scattering > 0.0 || lowest.medium.absorption > 0.0);
  SamplingPlan judging = plan;
  judging.judged = swallows ? 1 : 2;  // nothing passes an infinite depth
  const SamplingResult result = sample_until(judging, 3, walk);
  light.reflectance = result.quantities[0];
  light.transmittance = result.quantities[1];
  if (std::none_of(space.layers().begin(), space.layers().end(),
                   [](const Layer& layer) { return layer.medium.absorption > 0.0 && layer.medium.scattering == 0.0; }))
    light.absorptance = result.quantities[2];
  light.walks = result.samples;
  light.reached = result.reached;
  return light;
}

}  // namespace fathom
