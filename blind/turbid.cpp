#include "blind/turbid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/rng.h"

namespace fathom::blind {
namespace {

// The half-space is scaled to its free path: one walk serves every liquid. Cores of 0.25 … 64 free paths.
constexpr int kCores = 9, kPhotons = 20000, kMostScatterings = 400;
constexpr double kSineInside = 0.45;  // 37° in air in water: shifts are proportional to it

double core_of(int i) { return 0.25 * std::exp2(i); }

struct WalkedLight {
  std::array<double, kCores> shift{};     ///< of the weighed centroid, over that of the far field
  std::array<double, kCores> contrast{};  ///< weighed share of what leaves
};

WalkedLight walk() {
  std::array<double, kCores> weight{}, moment{};
  double left = 0.0;
  const double cosine = std::sqrt(1.0 - kSineInside * kSineInside);
  for (int photon = 0; photon < kPhotons; ++photon) {
    Rng rng(0x7b1d, photon);
    double x = 0, y = 0, z = 0, dx = kSineInside, dy = 0, dz = cosine;
    for (int i = 0; i < kMostScatterings; ++i) {
      const double path = -std::log(1.0 - rng.uniform());
      if (z + path * dz < 0.0) break;  // what the surface mirrors back is spread far from the core
      x += path * dx, y += path * dy, z += path * dz;
      // Towards the camera, on the side away from where the light came: what is not scattered again on its last way.
      const double last = z / cosine, light = std::exp(-last), out = x + last * kSineInside;
      left += light;
      for (int k = 0; k < kCores; ++k) {
        const double w = light * std::exp(-0.5 * (out * out + y * y) / (core_of(k) * core_of(k)));
        weight[k] += w;
        moment[k] += w * out;
      }
      dz = 2.0 * rng.uniform() - 1.0;
      const double azimuth = 2.0 * std::numbers::pi * rng.uniform(), r = std::sqrt(1.0 - dz * dz);
      dx = r * std::cos(azimuth), dy = r * std::sin(azimuth);
    }
  }
  WalkedLight table;
  for (int k = 0; k < kCores; ++k) {
    table.shift[k] = moment[k] / weight[k] / (2.0 * kSineInside);
    table.contrast[k] = weight[k] / left;
  }
  return table;
}

const WalkedLight& walked() {
  static const WalkedLight table = walk();
  return table;
}

double interpolated(const std::array<double, kCores>& values, double core_in_paths) {
  const double at = std::clamp(std::log2(core_in_paths / 0.25), 0.0, kCores - 1.0);
  const int i = std::min(static_cast<int>(at), kCores - 2);
  return values[i] + (at - i) * (values[i + 1] - values[i]);
}

}  // namespace

double turbid_shift(double index, double reduced_scattering, double core) {
  return 1.0 / (index * reduced_scattering) * interpolated(walked().shift, core * reduced_scattering);
}

double turbid_contrast(double reduced_scattering, double core) {
  return interpolated(walked().contrast, core * reduced_scattering);
}

}  // namespace fathom::blind
