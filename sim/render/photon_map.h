// The projector's light that no search for connections finds: reflected in part by two interfaces or more, or led
// through more of them than a Fan follows. It is some hundredths of the light in a glass, spread out over all that
// stands in and around it. So packets of it are traced from the source once, and what arrives near a place is added up
// there (Jensen 1996).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "sim/render/shoot.h"

namespace fathom {

/// A packet of light where it arrives: on an opaque surface, or where it enters a body that scatters.
struct Photon {
  Eigen::Vector3f point;      ///< [m] world
  Eigen::Vector3f normal;     ///< unit, of the surface, on the side that it arrives on
  Eigen::Vector3f direction;  ///< unit, in which it left the source
  float power;                ///< [sr] per unit radiant intensity of the source in that direction
};

class PhotonMap {
 public:
  /// Photons count for places that lie less than this [m] from them.
  static constexpr double kRadius = 4e-3;

  /// Same arguments, same photons, for any number of threads.
  PhotonMap(const Intersector& world, const Source& source, std::uint64_t seed);

  /// Calls `visit(direction, irradiance)` for each photon near `point` [m] on a surface that has this unit normal:
  /// in which direction it left the source, and what it stands for there [1/m²], per unit radiant intensity. Within
  /// kRadius of its edge a surface seems darker, down to half at the edge.
  template <class Visit>
  void near(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, Visit&& visit) const {
    constexpr double kArea = std::numbers::pi * kRadius * kRadius;
    const std::vector<std::uint32_t>* box = box_near(point);
    if (!box) return;
    const Eigen::Vector3f at = point.cast<float>(), facing = normal.cast<float>();
    for (const std::uint32_t number : *box)
      if (const Photon& photon = photons_[number]; lights(photon, at, facing))
        visit(Eigen::Vector3d(photon.direction.cast<double>()), photon.power / kArea);
  }

  const std::vector<Photon>& photons() const { return photons_; }

 private:
  static bool lights(const Photon& photon, const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
    constexpr float kSameNormal = 0.9f;  // 26 degrees
    constexpr float kSamePlane = 5e-4f;  // [m] a cup's wall bends by less
    const Eigen::Vector3f apart = point - photon.point;
    return apart.squaredNorm() < static_cast<float>(kRadius * kRadius) && photon.normal.dot(normal) > kSameNormal &&
           std::abs(apart.dot(normal)) < kSamePlane;
  }
  const std::vector<std::uint32_t>* box_near(const Eigen::Vector3d& point) const;

  std::vector<Photon> photons_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> boxes_;
};

}  // namespace fathom
