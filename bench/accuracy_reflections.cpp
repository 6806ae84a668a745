#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bench/accuracy.h"
#include "bench/bench_scene.h"
#include "core/files.h"
#include "core/rng.h"
#include "sim/optics/interface.h"
#include "sim/render/crossing.h"

namespace fathom {
namespace {

/// Power that arrives on the diffuse surfaces in and below a cup, by how often an interface reflected it in part on its
/// way: never, once, twice or more. Total reflection is no such reflection.
using Arrived = std::array<double, 3>;

/// One packet of the projector's light to the first diffuse surface, by chance at each interface.
void follow(const Intersector& world, const Cup& cup, Walker walker, Rng& rng, Arrived& arrived) {
  constexpr int kMost = 100;  // interfaces: what is caught in glass has long lost its light
  std::size_t reflections = 0;
  for (int i = 0; i < kMost; ++i) {
    const auto hit = world.first_hit({walker.position, walker.direction});
    if (!hit) return;
    const Body* from = medium_in(world.geometry(), walker.region);
    walker.weight *= std::exp(-extinction_of(from) * hit->distance);
    walker.position = hit->point;
    if (!std::holds_alternative<Interface>(hit->surface->optics)) {
      const double radius = std::get<CupShape>(cup.shape).widest();
      if ((hit->point.head<2>() - cup.position).norm() < radius)
        arrived[std::min(reflections, arrived.size() - 1)] += walker.weight;
      return;
    }
    const BodySet after = beyond(*hit, walker.region);
    const Body* to = medium_in(world.geometry(), after);
    const double cosine = std::clamp(-walker.direction.dot(hit->normal), 0.0, 1.0);
    if (from == to || cross_interface(walker, hit->normal, index_of(from), index_of(to), rng))
      walker.region = after;
    else if (fresnel_reflectance(cosine, index_of(from), index_of(to)) < 1.0)
      ++reflections;
  }
}

/// The projector's light on a disc about the cup's rim, evenly over the disc.
Arrived arrived_in(const Setup& setup) {
  constexpr int kPackets = 4'000'000;
  const BenchScene scene(setup);
  const Cup& cup = setup.scene.cups.at(0);
  const CupShape& shape = std::get<CupShape>(cup.shape);
  const Eigen::Vector3d projector = setup.rig.projector_in_world();
  Arrived arrived{};
  Rng rng(1);
  for (int i = 0; i < kPackets; ++i) {
    const double radius = 1.5 * shape.widest() * std::sqrt(rng.uniform()),
                 angle = 2.0 * std::numbers::pi * rng.uniform();
    const Eigen::Vector3d target(cup.position.x() + radius * std::cos(angle),
                                 cup.position.y() + radius * std::sin(angle), shape.height());
    const Eigen::Vector3d way = target - projector;
    Walker walker{projector, way.normalized()};
    walker.weight = -walker.direction.z() / way.squaredNorm();
    follow(scene.world, cup, walker, rng, arrived);
  }
  return arrived;
}

Setup without_liquid(Setup setup) {
  setup.scene.cups[0].filling.reset();
  return setup;
}

}  // namespace

void compare_reflections() {
  print_title("Light in cups that interfaces reflected in part, beside light that none did [%]");
  const Setup glass = read_setup(data_directory() / "glass_water.json");
  const std::pair<const char*, Setup> scenes[] = {
      {"paper_water", paper_water()}, {"glass_water", glass}, {"glass_water, emptied", without_liquid(glass)}};
  for (const auto& [name, setup] : scenes) {
    const Arrived arrived = arrived_in(setup);
    print_figure(fmt::format("{}: reflected once", name), 100.0 * arrived[1] / arrived[0], {}, "");
    print_figure("       twice or more", 100.0 * arrived[2] / arrived[0], {}, "");
  }
  print_note("Captures have what is reflected once on the way to the surface, or once on the way from there, or both.");
  print_note("By reciprocity as much light is reflected so on the camera's side as on the projector's.");
}

}  // namespace fathom
