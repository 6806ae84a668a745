#include "sim/optics/water.h"

#include <cmath>

namespace fathom {

double water_density(double t) {
  const double numerator =
      999.83952 + t * (16.945176 + t * (-7.9870401e-3 + t * (-46.170461e-6 + t * (105.56302e-9 - t * 280.54253e-12))));
  return numerator / (1.0 + 16.879850e-3 * t);
}

double water_index(double wavelength_nm, double temperature_c) {
  // Reduced by 589 nm, 1000 kg/m³ and 273.15 K.
  const double wavelength = wavelength_nm / 589.0, wavelength2 = wavelength * wavelength;
  const double density = water_density(temperature_c) / 1000.0;
  const double temperature = (temperature_c + 273.15) / 273.15;
  constexpr double kUltraviolet = 0.2292020, kInfrared = 5.432937;
  // (n² − 1) / (n² + 2) per reduced density
  const double refractivity = 0.244257733 + 9.74634476e-3 * density - 3.73234996e-3 * temperature +
                              2.68678472e-4 * wavelength2 * temperature + 1.58920570e-3 / wavelength2 +
                              2.45934259e-3 / (wavelength2 - kUltraviolet * kUltraviolet) +
                              0.900704920 / (wavelength2 - kInfrared * kInfrared) - 1.66626219e-2 * density * density;
  const double a = density * refractivity;
  return std::sqrt((1.0 + 2.0 * a) / (1.0 - a));
}

}  // namespace fathom
