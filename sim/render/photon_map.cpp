#include "sim/render/photon_map.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/rng.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/medium.h"
#include "sim/optics/snell.h"
#include "sim/render/body_directions.h"
#include "sim/render/boxes.h"
#include "sim/render/fan.h"

namespace fathom {
namespace {

constexpr std::uint64_t kPhotonStream = 0x70686f746fULL;

/// Packets from each cell of directions. About 20 photons count for a place in a glass.
constexpr int kPerCell = 32;

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
    photons.push_back(
        {hit.point.cast<float>(), hit.normal.cast<float>(), direction, static_cast<float>(path.weight * solid_angle)});
  };
  while (path.crossings < kMostCrossings && goes_on(path, rng)) {
    const auto hit = world.first_hit(path.ray);
    if (!hit) return;
    const Body* from = medium_in(world.geometry(), path.inside);
    path.weight *= transmittance(extinction_of(from), hit->distance);
    path.ray.origin = hit->point;
    if (!std::holds_alternative<Interface>(hit->surface->optics)) {
      if (path.is_left_out()) arrives(*hit);
      return;
    }
    const BodySet after = beyond(*hit, path.inside);
    const Body* to = medium_in(world.geometry(), after);
    if (from == to) {
      path.inside = after;
      continue;
    }
    ++path.crossings;
    const auto bent = refract(path.ray.direction, hit->normal, index_of(from), index_of(to));
    // Of what enters a body that scatters all counts where it does so.
    const bool is_taken_up = bent && to && to->scatters() && path.is_left_out();
    if (is_taken_up) arrives(*hit);
    const double cosine = std::clamp(-path.ray.direction.dot(hit->normal), 0.0, 1.0),
                 reflectance = fresnel_reflectance(cosine, index_of(from), index_of(to)),
                 chance = chance_of_reflection(path, reflectance);
    if (bent && rng.uniform() >= chance) {
      if (is_taken_up) return;
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

PhotonMap::PhotonMap(const Intersector& world, const Source& source, std::uint64_t seed) {
  const std::vector<DirectionCell> cells = directions_to_bodies(world.geometry(), source.position);
  std::vector<std::vector<Photon>> of_cell(cells.size());
  parallel_rows(static_cast<int>(cells.size()), [&](int cell) {
    Rng rng(seed, kPhotonStream, cell);
    for (int packet = 0; packet < kPerCell; ++packet) {
      const double right = rng.uniform() - 0.5, up = rng.uniform() - 0.5;
      const Ray ray{source.position, cells[cell].at({right, up})};
      trace(world, {ray, source.inside}, cells[cell].solid_angle() / kPerCell, rng, of_cell[cell]);
    }
  });
  for (const std::vector<Photon>& some : of_cell) photons_.insert(photons_.end(), some.begin(), some.end());
  for (std::uint32_t photon = 0; photon < photons_.size(); ++photon)
    for_each_box(photons_[photon].point.cast<double>(), kRadius,
                 [&](std::uint64_t key) { boxes_[key].push_back(photon); });
}

const std::vector<std::uint32_t>* PhotonMap::box_near(const Eigen::Vector3d& point) const {
  const auto box = boxes_.find(box_around(point));
  return box == boxes_.end() ? nullptr : &box->second;
}

}  // namespace fathom
