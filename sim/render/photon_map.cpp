#include "sim/render/photon_map.h"

#include <algorithm>
#include <cmath>

#include "core/rng.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"
#include "sim/render/body_directions.h"
#include "sim/render/boxes.h"
#include "sim/render/fan.h"

namespace fathom {
namespace {

constexpr std::uint64_t kPhotonStream = 0x70686f746fULL;

/// Packets from each cell of directions. In a glass some 60,000 of them become photons: about 15 count for a place.
constexpr int kPerCell = 64;

/// A packet on its way.
struct PhotonPath {
  Ray ray;
  BodySet inside;
  double weight = 1.0;  ///< power that is left of it
  int crossings = 0;    ///< as Fan counts them: interfaces, total reflections among them
  int reflections = 0;  ///< in part

  bool is_left_out() const { return reflections >= 2 || crossings > kLongestChain; }
};

/// Chance with which an interface of this reflectance reflects a path. Most light is never reflected twice, so the
/// first two times are made more likely.
double chance_of_reflection(const PhotonPath& path, double reflectance) {
  constexpr double kOften = 0.3;
  return path.is_left_out() ? reflectance : std::max(reflectance, kOften);
}

/// Russian roulette: false where the packet ends.
bool goes_on(PhotonPath& path, Rng& rng) {
  constexpr double kLeast = 0.02;
  if (path.weight >= kLeast) return true;
  if (kLeast * rng.uniform() >= path.weight) return false;
  path.weight = kLeast;
  return true;
}

void trace(const Intersector& world, PhotonPath path, double solid_angle, Rng& rng, std::vector<Photon>& photons) {
  const Eigen::Vector3f direction = path.ray.direction.cast<float>();
  const auto arrives = [&](const Hit& hit) {
    if (!path.is_left_out()) return;
    photons.push_back({hit.point.cast<float>(), hit.normal.cast<float>(), path.ray.direction.cast<float>(), direction,
                       static_cast<float>(path.weight * solid_angle)});
  };
  while (path.crossings < kMostCrossings && goes_on(path, rng)) {
    const auto hit = world.first_hit(path.ray);
    if (!hit) return;
    const Body* from = medium_in(world.geometry(), path.inside);
    path.weight *= transmittance(extinction_of(from), hit->distance);
    path.ray.origin = hit->point;
    if (!std::holds_alternative<Interface>(hit->surface->optics)) return arrives(*hit);
    const BodySet after = beyond(*hit, path.inside);
    const Body* to = medium_in(world.geometry(), after);
    if (from == to) {
      path.inside = after;
      continue;
    }
    ++path.crossings;
    if (to && to->scatters()) arrives(*hit);
    const double cosine = std::clamp(-path.ray.direction.dot(hit->normal), 0.0, 1.0),
                 reflectance = fresnel_reflectance(cosine, index_of(from), index_of(to)),
                 chance = chance_of_reflection(path, reflectance);
    const auto bent = refract(path.ray.direction, hit->normal, index_of(from), index_of(to));
    if (bent && rng.uniform() >= chance) {
      path.weight *= (1.0 - reflectance) / (1.0 - chance);
      path.ray.direction = *bent;
      path.inside = after;
    } else {
      if (bent) path.weight *= reflectance / chance, ++path.reflections;
      path.ray.direction = reflect(path.ray.direction, hit->normal);
    }
  }
}

}  // namespace

PhotonMap::PhotonMap(const Intersector& world, const Source& source) {
  std::uint64_t number = 0;
  for (const DirectionCell& cell : directions_to_bodies(world.geometry(), source.position)) {
    Rng rng(kPhotonStream, number++);
    for (int packet = 0; packet < kPerCell; ++packet) {
      const double right = rng.uniform() - 0.5, up = rng.uniform() - 0.5;
      const Ray ray{source.position, cell.at({right, up})};
      trace(world, {ray, source.inside}, cell.solid_angle() / kPerCell, rng, photons_);
    }
  }
  for (std::uint32_t photon = 0; photon < photons_.size(); ++photon)
    for_each_box(photons_[photon].point.cast<double>(), kRadius,
                 [&](std::uint64_t key) { boxes_[key].push_back(photon); });
}

const std::vector<std::uint32_t>* PhotonMap::box_near(const Eigen::Vector3d& point) const {
  const auto box = boxes_.find(box_around(point));
  return box == boxes_.end() ? nullptr : &box->second;
}

}  // namespace fathom
