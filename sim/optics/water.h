// The refractive index of water, at any temperature.
#pragma once

namespace fathom {

/// Density of liquid water at atmospheric pressure [kg/m³]. Kell, J. Chem. Eng. Data 20, 1975; 0 … 100 °C, 0.01 kg/m³.
double water_density(double temperature_c);

/// Index against vacuum by the Lorentz–Lorenz relation of IAPWS R9-97 (Harvey, Gallagher & Levelt Sengers, J. Phys.
/// Chem. Ref. Data 27, 1998) at the density above; 200 … 1100 nm, 0 … 100 °C. 1.5e-5 in the visible; against Daimon &
/// Masumura (2007, 20 °C) 4e-6 at 830 nm and 6e-5 at 1064 nm.
double water_index(double wavelength_nm, double temperature_c);

inline constexpr double kWaterMinNm = 200.0, kWaterMaxNm = 1100.0;

}  // namespace fathom
