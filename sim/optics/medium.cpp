#include "sim/optics/medium.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "core/error.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/water.h"

namespace fathom {
namespace {

double index_at(const ConstantIndex& constant, double) { return constant.n; }

double index_at(const SellmeierIndex& sellmeier, double wavelength_nm) {
  const double lambda2_um2 = wavelength_nm * wavelength_nm * 1e-6;
  double n_squared = 1.0;
  for (std::size_t i = 0; i < sellmeier.a.size(); ++i)
    n_squared += sellmeier.a[i] * lambda2_um2 / (lambda2_um2 - sellmeier.b_um2[i]);
  return std::sqrt(n_squared);
}

double index_at(const WaterIndex& like_water, double wavelength_nm) {
  return water_index(wavelength_nm, like_water.temperature_c) + like_water.above_water;
}

}  // namespace

double Medium::n(double wavelength_nm) const {
  if (wavelength_nm < wavelength_min_nm || wavelength_nm > wavelength_max_nm)
    throw Error(name, fmt::format("refractive index asked at {} nm, known from {} to {} nm", wavelength_nm,
                                  wavelength_min_nm, wavelength_max_nm));
  return std::visit([&](const auto& law) { return index_at(law, wavelength_nm); }, index);
}

double transmittance(double coefficient, double path) { return std::exp(-coefficient * path); }

double diffuse_reflectance(const Medium& medium, double n) {
  assert(medium.scatters());
  const double k = 2.0 * medium.absorption;
  const double s = std::fmax(0.75 * medium.reduced_scattering() - 0.25 * medium.absorption, 1e-9);
  const double below_surface = 1.0 + k / s - std::sqrt(k / s * (k / s + 2.0));
  const double outside = hemispherical_reflectance(1.0, n);
  const double inside = 1.0 - 1.0 / n * (1.0 / n) * (1.0 - outside);  // the same paths backwards
  return (1.0 - outside) * (1.0 - inside) * below_surface / (1.0 - inside * below_surface);
}

}  // namespace fathom
