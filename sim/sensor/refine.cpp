#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"
#include "sim/sensor/window_sums.h"

namespace fathom {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr float kCount = kRefineColumns * kRefineRows;
constexpr int kHalfColumns = kRefineColumns / 4;  ///< [depth px] half a window

/// The surfaces that the search found in a tile: the windows of one are all compared with the reference at one shift.
struct TileSurfaces {
  static constexpr int kMost = kTileColumns / 2;  ///< one for each searched pixel
  static_assert(kTileRows == kSearchStep, "a tile holds one searched row");

  int count = 0;
  std::array<float, kMost> searched;      ///< mean disparity of each [px]
  std::array<float, kMost> found;         ///< the same, refined; NaN: nothing
  std::array<int, kTileColumns> of = {};  ///< for each column its surface, counted from 1; 0: none
};

TileSurfaces surfaces_in(const float* searched, int pixels) {
  constexpr float kTogether = 0.35f;  // [px] more than the search's error and the slope of a desk
  TileSurfaces surfaces;
  for (int seed = 0; seed < pixels; ++seed) {
    if (surfaces.of[2 * seed] != 0 || std::isnan(searched[seed])) continue;
    float sum = 0.0f, count = 0.0f;
    for (int k = seed; k < pixels; ++k)
      if (surfaces.of[2 * k] == 0 && std::fabs(searched[k] - searched[seed]) < 2.0f * kTogether)
        sum += searched[k], count += 1.0f;
    const float mean = surfaces.searched[surfaces.count++] = sum / count;
    for (int k = seed; k < pixels; ++k)
      if (surfaces.of[2 * k] == 0 && (std::fabs(searched[k] - mean) < kTogether || k == seed))
        surfaces.of[2 * k] = surfaces.of[2 * k + 1] = surfaces.count;
  }
  return surfaces;
}

/// A row of the estimates, as pointers to a tile's first pixel.
struct EstimatesRow {
  float *disparity, *correlation, *centre_x, *centre_y;
};

/// Where a tile's row of windows stands.
struct RowPlace {
  float disparity;    ///< [px] that the reference is shifted by
  float column, row;  ///< of the tile's first sample, from the row's first pixel centre [depth px]
  float least_energy, least_correlation;
};

/// The shift t that maximises the correlation of i with r + t g, (a + t b) / √(ii (rr + 2 t rg + t² gg)), with the
/// correlation there, for those columns that are `label`'s. A window without contrast or maximum gives no
/// match.
template <int kWidth>
inline __attribute__((always_inline)) void solve_row_of(const float (&sums)[kWindowSums][kTileColumns],
                                                        const RowPlace place, const int* __restrict labels, int label,
                                                        int width, const EstimatesRow& out) {
  constexpr float kFarthest = 0.75f;  // [px]; beyond, the derivative says nothing
  constexpr float kPerCount = 1.0f / kCount;
  constexpr float kTiny = 1e-12f;
  float *disparity = out.disparity, *correlation = out.correlation;
  float *centre_x = out.centre_x, *centre_y = out.centre_y;
#pragma GCC ivdep
  for (int k = 0; k < (kWidth > 0 ? kWidth : width); ++k) {
    const float i = sums[kI][k], r = sums[kR][k], g = sums[kG][k];
    const float mean = i * kPerCount;
    const float ii = sums[kII][k] - i * mean;
    const float a = sums[kIR][k] - mean * r, b = sums[kIG][k] - mean * g;
    const float rr = sums[kRR][k] - r * r * kPerCount;
    const float rg = sums[kRG][k] - r * g * kPerCount;
    const float gg = sums[kGG][k] - g * g * kPerCount;
    const float denominator = a * gg - b * rg;
    const float t = (b * rr - a * rg) / (denominator > kTiny ? denominator : kTiny);
    const float energy = rr + 2.0f * t * rg + t * t * gg;
    const float both = a + t * b;
    const float squared = ii * energy;
    const float own_correlation = both / std::sqrt(squared > kTiny ? squared : kTiny);
    // No short-circuit: branches would keep the compiler from making vectors of this.
    const bool good = (denominator > kTiny) & (ii > place.least_energy) & (t < kFarthest) & (t > -kFarthest) &
                      (energy > kTiny) & (own_correlation >= place.least_correlation);
    const float per_energy = 1.0f / (sums[kGG][k] + 1e-9f);
    const float own_x = place.column + 0.5f * sums[kGGx][k] * per_energy - static_cast<float>(k);
    const float own_y = place.row + sums[kGGy][k] * per_energy;
    const float found = good ? place.disparity - t : kNone, found_correlation = good ? own_correlation : 0.0f;
    const bool own = labels[k] == label;
    disparity[k] = own ? found : disparity[k];
    correlation[k] = own ? found_correlation : correlation[k];
    centre_x[k] = own ? own_x : centre_x[k];
    centre_y[k] = own ? own_y : centre_y[k];
  }
}

FATHOM_SIMD_CLONES
void solve_row(const float (&sums)[kWindowSums][kTileColumns], const RowPlace& place, const int* labels, int label,
               int width, const EstimatesRow& out) {
  if (width == kTileColumns)
    solve_row_of<kTileColumns>(sums, place, labels, label, width, out);
  else
    solve_row_of<0>(sums, place, labels, label, width, out);
}

class Refiner {
 public:
  Refiner(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference,
          const Image<float>& coarse, Estimates& estimates)
      : sensor_(sensor), paired_(paired), reference_(reference), coarse_(coarse), estimates_(estimates) {}

  /// Refines the rows of windows whose first depth row is y, tile after tile.
  void refine_rows(int y) {
    left_ = {};
    for (int x = kHalfColumns; x < sensor_.width - kHalfColumns; x += kTileColumns) refine_tile(x, y);
    for (int j = y; j < std::min(y + kTileRows, sensor_.height); ++j) extend_row(j);
  }

 private:
  void refine_tile(int x, int y) {
    const int width = std::min(kTileColumns, sensor_.width - kHalfColumns - x);
    TileSurfaces surfaces = surfaces_in(coarse_.row(y / kSearchStep) + x / 2, (width + 1) / 2);
    for (int k = 0; k < surfaces.count; ++k) surfaces.found[k] = refine_surface(x, y, width, surfaces, k);
    left_ = surfaces;
  }

  /// Returns the mean disparity that was found; NaN where nothing was.
  float refine_surface(int x, int y, int width, const TileSurfaces& surfaces, int surface) {
    const float disparity = start(surfaces.searched[surface]);
    const ReferenceShift shift = reference_shift(disparity);
    const int row = first_sample_row(y), end = std::min(y + kTileRows, sensor_.height), label = surface + 1;
    sum_windows(live(x, row), shifted(reference_.value, shift, x, row), shifted(reference_.slope, shift, x, row),
                first_sample_row(end - 1) - row + 1, sums_);
    const float contrast = static_cast<float>(sensor_.matcher.contrast_min);
    RowPlace place{disparity + shift.rest_px, 0.25f - kHalfColumns, 0.0f, contrast * contrast * kCount,
                   static_cast<float>(sensor_.matcher.correlation_min)};
    float sum = 0.0f, count = 0.0f;
    for (int j = y; j < end; ++j) {
      place.row = static_cast<float>(row - sensor_.ir_first_row() / 2 - j);
      const EstimatesRow out = estimates_row(x, j);
      solve_row(sums_.of[first_sample_row(j) - row], place, surfaces.of.data(), label, width, out);
      for (int k = 0; k < width; ++k)
        if (surfaces.of[k] == label && !std::isnan(out.disparity[k])) sum += out.disparity[k], count += 1.0f;
    }
    return count > 0.0f ? sum / count : kNone;
  }

  /// Where a surface goes on from the tile on the left, what was found there is nearer the truth than the search is.
  float start(float searched) const {
    constexpr float kSame = 0.25f;  // [px]
    for (int k = 0; k < left_.count; ++k)
      if (std::fabs(left_.searched[k] - searched) < kSame && !std::isnan(left_.found[k])) return left_.found[k];
    return searched;
  }

  /// Pixels less than half a window from the image's sides take the estimate of the nearest whole window.
  void extend_row(int y) {
    const int border = sensor_.matcher.window_columns / 4, last = sensor_.width - 1;
    for (int x = 0; x < kHalfColumns; ++x) {
      copy(kHalfColumns, x, y, x >= border);
      copy(last - kHalfColumns, last - x, y, x >= border);
    }
    for (int x = kHalfColumns; x < border; ++x) estimates_.disparity(x, y) = estimates_.disparity(last - x, y) = kNone;
  }

  /// First row pair of the windows of a depth row; windows stay inside the infrared image.
  int first_sample_row(int depth_row) const {
    return std::clamp(sensor_.ir_first_row() / 2 + depth_row - kRefineRows / 2, 0, sensor_.ir_height / 2 - kRefineRows);
  }

  TileImage live(int x, int row) const {
    return {paired_.odd.row(row) + x - kHalfColumns, paired_.even.row(row) + x - kHalfColumns + 1,
            paired_.even.width()};
  }

  TileImage shifted(const std::array<Image<float>, kPhases>& phases, const ReferenceShift& even, int x, int row) const {
    const ReferenceShift odd = even.odd();
    const int column = x - kHalfColumns + reference_.margin_px;  // the margin holds every disparity searched
    return {phases[odd.phase].row(row) + column + odd.whole, phases[even.phase].row(row) + column + even.whole + 1,
            phases[0].width()};
  }

  EstimatesRow estimates_row(int x, int y) {
    const auto at = [&](Image<float>& image) { return image.row(y) + x; };
    return {at(estimates_.disparity), at(estimates_.correlation), at(estimates_.centre_x), at(estimates_.centre_y)};
  }

  void copy(int from, int to, int y, bool valid) {
    Estimates& e = estimates_;
    for (Image<float>* image : {&e.disparity, &e.correlation, &e.centre_x, &e.centre_y})
      (*image)(to, y) = (*image)(from, y);
    e.centre_x(to, y) += static_cast<float>(from - to);
    if (!valid) e.disparity(to, y) = kNone;
  }

  const SensorModel& sensor_;
  const SplitColumns<float>& paired_;
  const Reference& reference_;
  const Image<float>& coarse_;
  Estimates& estimates_;
  TileSurfaces left_;  ///< of the tile on the left
  TileSums sums_;
};

}  // namespace

Estimates refine(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference,
                 const Image<float>& coarse) {
  Estimates estimates(sensor.width, sensor.height);
  if (sensor.width <= 2 * kHalfColumns || sensor.ir_height < 2 * kRefineRows) return estimates;  // no whole window
  const int tiles_down = (sensor.height + kTileRows - 1) / kTileRows;
  parallel_ranges(tiles_down, [&](int begin, int end) {
    Refiner refiner(sensor, paired, reference, coarse, estimates);
    for (int tile = begin; tile < end; ++tile) refiner.refine_rows(tile * kTileRows);
  });
  return estimates;
}

}  // namespace fathom
