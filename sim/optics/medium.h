// A homogeneous liquid: how it bends, absorbs and scatters light, each number with its source.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace fathom {

/// The same index at every wavelength inside the cited range.
struct ConstantIndex {
  double n = 1.0;

  bool operator==(const ConstantIndex&) const = default;
};

/// Sellmeier's n² − 1 = Σ Aᵢ λ² / (λ² − Bᵢ), λ in µm.
struct SellmeierIndex {
  std::vector<double> a;      ///< dimensionless
  std::vector<double> b_um2;  ///< µm²

  bool operator==(const SellmeierIndex&) const = default;
};

/// Water's index (see water.h) plus a difference that is the same at every wavelength and temperature: for liquids that
/// are mostly water. What their solutes add to its dispersion is neglected.
struct WaterIndex {
  double temperature_c = 20.0;
  double above_water = 0.0;

  bool operator==(const WaterIndex&) const = default;
};

struct Medium {
  std::string name;
  std::variant<ConstantIndex, SellmeierIndex, WaterIndex> index = ConstantIndex{};
  double wavelength_min_nm = 0.0;  ///< range of the cited numbers
  double wavelength_max_nm = 1e9;
  double absorption = 0.0;             ///< coefficient μa [1/m]
  double absorption_per_kelvin = 0.0;  ///< its change with temperature [1/(m K)]
  double scattering = 0.0;             ///< coefficient μs [1/m]
  double anisotropy = 0.0;             ///< mean cosine g of the scattering angle
  std::string source;                  ///< where the numbers come from and how good they are

  /// Refractive index relative to vacuum. Throws Error outside the cited range.
  double n(double wavelength_nm) const;
  bool scatters() const { return scattering > 0.0; }
  double reduced_scattering() const { return scattering * (1.0 - anisotropy); }  ///< μs′ [1/m]

  bool operator==(const Medium&) const = default;
};

/// Beer–Lambert: the fraction of light left after `path` [m] in a medium of extinction coefficient `coefficient` [1/m].
double transmittance(double coefficient, double path);

/// Diffuse reflectance of a semi-infinite scattering medium under air for diffusely arriving light, by two-flux theory
/// with the internal reflection of the surface taken into account (Saunderson 1942; Kubelka & Munk with K = 2 μa,
/// S = ¾ μs(1 − g) − ¼ μa): the albedo of an opaque liquid seen as a surface. `n` is the liquid's index.
double diffuse_reflectance(const Medium& medium, double n);

}  // namespace fathom
