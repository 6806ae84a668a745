#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "bench/accuracy.h"
#include "bench/bench_scene.h"
#include "core/estimate.h"
#include "core/files.h"
#include "core/rng.h"
#include "sim/optics/interface.h"
#include "sim/render/connection.h"
#include "sim/render/crossing.h"
#include "sim/render/photon_map.h"

namespace fathom {
namespace {

/// Power on the desk below and around a glass [of unit radiant intensity of the projector].
struct OnDesk {
  Estimate once_or_never;  ///< reflected in part by one interface on the way, or none
  Estimate all;
};

Estimate over(double area, const Mean& mean) {
  return {area * mean.estimate().value, area * mean.estimate().standard_error};
}

bool is_near(const Eigen::Vector2d& place, const Cup& cup, double around) {
  return (place - cup.position).norm() < around;
}

/// By packets that are evenly drawn from all that go through a disc about the cup's rim, each reflected by chance at
/// each interface.
OnDesk traced(const Setup& setup, const BenchScene& scene, double around) {
  constexpr int kPackets = 2'000'000;
  constexpr int kMost = 100;  // interfaces: what is caught in glass has long lost its light
  const Cup& cup = setup.scene.cups.at(0);
  const double top = std::get<CupShape>(cup.shape).height(), radius = 1.6 * around;
  const Eigen::Vector3d projector = setup.rig.projector_in_world();
  Mean once, all;
  Rng rng(1);
  for (int i = 0; i < kPackets; ++i) {
    const double far = radius * std::sqrt(rng.uniform()), angle = 2.0 * std::numbers::pi * rng.uniform();
    const Eigen::Vector3d way =
        Eigen::Vector3d(cup.position.x() + far * std::cos(angle), cup.position.y() + far * std::sin(angle), top) -
        projector;
    Walker walker{projector, way.normalized()};
    walker.weight = -walker.direction.z() / way.squaredNorm();
    int reflections = 0;
    double arrived = 0.0;
    for (int met = 0; met < kMost; ++met) {
      const auto hit = scene.world.first_hit({walker.position, walker.direction});
      if (!hit) break;
      const Body* from = medium_in(scene.world.geometry(), walker.region);
      walker.weight *= std::exp(-extinction_of(from) * hit->distance);
      walker.position = hit->point;
      if (!std::holds_alternative<Interface>(hit->surface->optics)) {
        if (is_near(hit->point.head<2>(), cup, around)) arrived = walker.weight;
        break;
      }
      const BodySet after = beyond(*hit, walker.region);
      const double n_from = index_of(from), n_to = index_of(medium_in(scene.world.geometry(), after));
      const bool in_part = refract(walker.direction, hit->normal, n_from, n_to).has_value();
      if (cross_interface(walker, hit->normal, n_from, n_to, rng))
        walker.region = after;
      else
        reflections += in_part;
    }
    all.add(arrived);
    once.add(reflections < 2 ? arrived : 0.0);
  }
  const double area = std::numbers::pi * radius * radius;
  return {over(area, once), over(area, all)};
}

/// By what captures ask for at places on the desk.
OnDesk asked_for(const Setup& setup, const BenchScene& scene, double around) {
  constexpr int kPlaces = 100'000;
  const Cup& cup = setup.scene.cups.at(0);
  constexpr double kAbove = 0.5;  // [m]
  const PhotonMap photons(scene.world, scene.projector.source(), 1);
  Mean once, all;
  Rng rng(2);
  for (int i = 0; i < kPlaces; ++i) {
    const double far = around * std::sqrt(rng.uniform()), angle = 2.0 * std::numbers::pi * rng.uniform();
    const Eigen::Vector3d above(cup.position.x() + far * std::cos(angle), cup.position.y() + far * std::sin(angle),
                                kAbove);
    const auto place = see(scene.world, {above, -Eigen::Vector3d::UnitZ()});  // level surfaces do not bend this ray
    double irradiance = 0.0;
    const auto add = [&](const Connection& way) {
      irradiance -= way.transmittance * way.spreading * place->normal.dot(way.arrival);
    };
    const Receiver receiver{place->point, place->around, &place->normal};
    scene.projector.connect(receiver, add);
    scene.projector.connect_mirrored(receiver, 1.0, rng.uniform(), add);
    once.add(irradiance);
    photons.near(place->point, place->normal, [&](const Eigen::Vector3d&, double more) { irradiance += more; });
    all.add(irradiance);
  }
  const double area = std::numbers::pi * around * around;
  return {over(area, once), over(area, all)};
}

void print_ratio(const std::string& what, const Estimate& one, const Estimate& other) {
  const double error =
      one.value / other.value * std::hypot(one.standard_error / one.value, other.standard_error / other.value);
  print_figure(fmt::format("{} (± {:.2f})", what, 100.0 * error), 100.0 * one.value / other.value, {}, "");
}

}  // namespace

void compare_reflections() {
  print_title("Light on the desk below and around a glass, beside light that is traced [%]");
  const Setup glass = read_setup(data_directory() / "glass_water.json");
  Setup empty = glass;
  empty.scene.cups[0].filling.reset();
  for (const auto& [name, setup] : {std::pair("glass_water", glass), std::pair("glass_water, emptied", empty)}) {
    const BenchScene scene(setup);
    const double around = 2.0 * std::get<CupShape>(setup.scene.cups[0].shape).widest();
    const OnDesk expected = traced(setup, scene, around), found = asked_for(setup, scene, around);
    print_ratio(fmt::format("{}: all", name), found.all, expected.all);
    print_ratio("       reflected in part at most once", found.once_or_never, expected.once_or_never);
    print_ratio("       the same light, of all that is traced", expected.once_or_never, expected.all);
  }
}

}  // namespace fathom
