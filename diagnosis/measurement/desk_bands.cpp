#include "diagnosis/measurement/desk_bands.h"

#include <cmath>

namespace fathom {
namespace {

constexpr double kReference = 25600.0;  // pixels of a whole band of rows
constexpr double kFewestPixels = 1000.0;
constexpr double kOfPlane = 2.0;  // of a plane's three parameters, each kind of bands feels so many

/// Mean over bands of the variance between trials [px²], times the pixels of a band and over kReference.
template <class Bands>
std::optional<double> variance_of(std::span<const DeskBands> trials, Bands DeskBands::*bands) {
  const auto n = static_cast<double>(trials.size());
  double sum = 0.0, seen = 0.0;
  for (std::size_t i = 0; i < std::tuple_size_v<Bands>; ++i) {
    double weight = 0.0, mean = 0.0, squares = 0.0;
    bool in_all = true;
    for (const DeskBands& trial : trials) {
      const RegionEstimate& band = (trial.*bands)[i];
      in_all = in_all && band.weight >= kFewestPixels;
      weight += band.weight / n;
      mean += band.mean / n;
    }
    if (!in_all) continue;
    for (const DeskBands& trial : trials) squares += std::pow((trial.*bands)[i].mean - mean, 2);
    sum += weight * squares / (n - 1.0);
    seen += 1.0;
  }
  if (seen <= 2.0 * kOfPlane) return std::nullopt;
  return sum / (seen - kOfPlane) / kReference;
}

}  // namespace

std::optional<BandScatter> scatter_of(std::span<const DeskBands> trials) {
  if (trials.size() < 2) return std::nullopt;
  const auto rows = variance_of(trials, &DeskBands::rows), columns = variance_of(trials, &DeskBands::columns);
  if (!rows || !columns) return std::nullopt;
  return BandScatter{std::sqrt(*rows), std::sqrt(*columns)};
}

}  // namespace fathom
