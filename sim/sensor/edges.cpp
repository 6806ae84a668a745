#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

constexpr int kReach = 4;  ///< [depth px] a window of 9 whose centre lies this far away just covers the pixel
constexpr int kOwnColumns = 8, kOwnRows = 3;  ///< [infrared px, row pairs] the square that counts as the pixel's own

struct Step {
  int dx, dy;
};
constexpr std::array<Step, 9> kAround{{{0, 0},
                                       {-kReach, 0},
                                       {kReach, 0},
                                       {0, -kReach},
                                       {0, kReach},
                                       {-kReach, -kReach},
                                       {kReach, -kReach},
                                       {-kReach, kReach},
                                       {kReach, kReach}}};

/// How alike the dots seen at a pixel and those a surface predicts there are.
struct Likeness {
  float both = 0.0f;       ///< Σ seen · predicted, both without the bias [DN²]
  float seen = 0.0f;       ///< Σ seen²
  float predicted = 0.0f;  ///< Σ predicted²

  float energy() const { return std::max(seen, predicted); }
  float correlation() const { return both / std::sqrt(seen * predicted + 1e-6f); }
};

/// At most kMost values, in place: edges are settled a hundred thousand times a frame.
template <class Value, std::size_t kMost>
class Few {
 public:
  void push_back(const Value& value) { values_[size_++] = value; }
  bool empty() const { return size_ == 0; }
  auto begin() { return values_.begin(); }
  auto begin() const { return values_.begin(); }
  auto end() { return values_.begin() + size_; }
  auto end() const { return values_.begin() + size_; }

 private:
  std::array<Value, kMost> values_;
  std::size_t size_ = 0;
};

/// A surface near a pixel, extended to the pixel.
struct LocalSurface {
  float disparity, slope_x, slope_y;
  float correlation, gain, bias;
  bool own;  ///< found by the pixel's own window
};

enum Surroundings : std::uint8_t { kClean, kCrease, kEdge };

/// Says of the pixels of a row what their windows meet. An edge: the disparity over ±kReach is far from straight, or
/// much more is left unexplained than in a neighbour's window, because of foreign dots. A crease: it bends.
FATHOM_SIMD_CLONES
void mark_surroundings(const float* disparity, const float* correlation, std::ptrdiff_t stride, std::uint8_t* marks,
                       int begin, int end) {
  constexpr float kBreak = 0.8f;  // [px]
  constexpr float kBend = 0.2f;   // [px]; 2 to 3 times the noise of such a difference
#pragma GCC ivdep
  for (int x = begin; x < end; ++x) {
    const float* d = disparity + x;
    const float* c = correlation + x;
    const float across = std::fabs(d[-kReach] - 2.0f * d[0] + d[kReach]);
    const float down = std::fabs(d[-kReach * stride] - 2.0f * d[0] + d[kReach * stride]);
    const float best_across = c[-kReach] > c[kReach] ? c[-kReach] : c[kReach];
    const float best_down = c[-kReach * stride] > c[kReach * stride] ? c[-kReach * stride] : c[kReach * stride];
    const float best = best_across > best_down ? best_across : best_down;
    const bool whole = (across < kBreak) & (down < kBreak) & (1.0f - c[0] < 2.0f * (1.0f - best) + 0.15f);
    const bool straight = (across < kBend) & (down < kBend);
    marks[x] = whole ? (straight ? kClean : kCrease) : kEdge;
  }
}

class EdgeSettler {
 public:
  EdgeSettler(const SensorModel& sensor, const Image<float>& paired, const Reference& reference,
              const Estimates& estimates)
      : sensor_(sensor),
        paired_(paired),
        reference_(reference),
        estimates_(estimates),
        marks_(sensor.width, sensor.height),
        noise_energy_(static_cast<float>(sensor.matcher.contrast_min * sensor.matcher.contrast_min) * kOwnColumns *
                      kOwnRows) {
    // The image's own border is no edge between surfaces.
    const int margin = sensor.matcher.window_columns / 4 + kReach;
    parallel_ranges(marks_.height() - 2 * kReach, [&](int begin, int end) {
      for (int y = begin + kReach; y < end + kReach; ++y)
        mark_surroundings(estimates.disparity.row(y), estimates.correlation.row(y), marks_.width(), marks_.row(y),
                          margin, marks_.width() - margin);
    });
  }

  /// Whether the windows around the pixel meet more than one surface.
  bool is_edge(int x, int y) const { return marks_(x, y) == kEdge; }

  /// The surface whose dots are most like those at the pixel; nothing when none is.
  std::optional<LocalSurface> settle(int x, int y) const {
    constexpr float kExplained = 0.5f;
    std::optional<LocalSurface> best;
    float best_correlation = kExplained;
    Few<LocalSurface, kAround.size()> surfaces = surfaces_around(x, y);
    if (surfaces.empty()) return best;
    const Neighbours neighbours = clean_neighbours(x, y);
    for (LocalSurface& surface : surfaces) {
      fit(neighbours, surface);
      const Likeness found = likeness(x, y, surface);
      // A pixel without dots, seen or predicted, keeps its own surface but takes no other's.
      if (found.energy() < noise_energy_ && surface.own) return surface;
      if (found.energy() < noise_energy_ || found.correlation() < best_correlation) continue;
      best_correlation = found.correlation();
      best = surface;
    }
    return best;
  }

 private:
  /// Inside the image and not in its border, where nothing is matched.
  bool inside(int x, int y) const {
    const int border = sensor_.matcher.window_columns / 4;
    return x >= border && x < marks_.width() - border && y >= 0 && y < marks_.height();
  }

  /// The different surfaces that the pixel's own and the neighbouring windows found, each from its best correlated
  /// window.
  Few<LocalSurface, kAround.size()> surfaces_around(int x, int y) const {
    constexpr float kDifferent = 0.6f;  // [px]
    Few<LocalSurface, kAround.size()> surfaces;
    for (const auto& [dx, dy] : kAround) {
      const int i = x + dx, j = y + dy;
      if (!inside(i, j) || !estimates_.valid(i, j)) continue;
      LocalSurface found{
          estimates_.disparity(i, j), estimates_.slope_x(i, j), estimates_.slope_y(i, j), estimates_.correlation(i, j),
          estimates_.gain(i, j),      estimates_.bias(i, j),    dx == 0 && dy == 0};
      found.disparity -= found.slope_x * static_cast<float>(dx) + found.slope_y * static_cast<float>(dy);
      const auto same = std::find_if(surfaces.begin(), surfaces.end(), [&](const LocalSurface& other) {
        return std::fabs(other.disparity - found.disparity) < kDifferent;
      });
      if (same == surfaces.end()) {
        surfaces.push_back(found);
      } else if (found.correlation > same->correlation) {
        found.own = same->own;
        *same = found;
      }
    }
    return surfaces;
  }

  struct Neighbour {
    float dx, dy, disparity;
  };
  static constexpr int kFar = 9, kStride = 3;  // [px]
  static constexpr int kAlong = 2 * kFar / kStride + 1;
  using Neighbours = Few<Neighbour, kAlong * kAlong>;

  /// Those neighbours whose windows meet one straight surface only: windows that reach over an edge or a crease are
  /// pulled by the other side's dots, and a fit carries their errors far.
  Neighbours clean_neighbours(int x, int y) const {
    Neighbours neighbours;
    for (int dy = -kFar; dy <= kFar; dy += kStride)
      for (int dx = -kFar; dx <= kFar; dx += kStride)
        if (inside(x + dx, y + dy) && marks_(x + dx, y + dy) == kClean && estimates_.valid(x + dx, y + dy))
          neighbours.push_back({static_cast<float>(dx), static_cast<float>(dy), estimates_.disparity(x + dx, y + dy)});
    return neighbours;
  }

  /// Fits a surface to those clean neighbours that lie on it; leaves it as it is where they are too few.
  static void fit(const Neighbours& neighbours, LocalSurface& surface) {
    for (const float same_surface :
         {0.6f, 0.15f, 0.05f}) {  // [px]; the later rounds leave out what lies beyond a crease
      constexpr int kEnough = 6;
      Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
      Eigen::Vector3f right = Eigen::Vector3f::Zero();
      for (const Neighbour& there : neighbours) {
        const float difference =
            there.disparity - surface.disparity - surface.slope_x * there.dx - surface.slope_y * there.dy;
        if (std::fabs(difference) > same_surface) continue;
        const Eigen::Vector3f row(1.0f, there.dx, there.dy);
        normal += row * row.transpose();
        right += row * difference;
      }
      if (normal(0, 0) < kEnough) break;
      Eigen::Matrix3f inverse;
      bool solvable = false;
      normal.computeInverseWithCheck(inverse, solvable, 1.0f);
      if (!solvable) break;  // all on one line
      const Eigen::Vector3f correction = inverse * right;
      surface.disparity += correction[0], surface.slope_x += correction[1], surface.slope_y += correction[2];
    }
  }

  Likeness likeness(int x, int y, const LocalSurface& surface) const {
    const ReferenceShift shift = reference_shift(surface.disparity);
    const int column = std::clamp(2 * x + 1 - kOwnColumns / 2, 0, paired_.width() - kOwnColumns);
    const int row = std::clamp(sensor_.ir_first_row() / 2 + y - kOwnRows / 2, 0, paired_.height() - kOwnRows);
    const int reference_column = column + 2 * reference_.margin_px + shift.whole;
    if (reference_column < 0 || reference_column + kOwnColumns > reference_.shifted[0].width()) return {};
    Likeness result;
    for (int j = row; j < row + kOwnRows; ++j) {
      const float* live = paired_.row(j) + column;
      const float* shifted = reference_.shifted[shift.phase].row(j) + reference_column;
      const float* gradient = reference_.gradient[shift.phase].row(j) + reference_column;
      for (int i = 0; i < kOwnColumns; ++i) {
        const float seen = live[i] - surface.bias;
        const float predicted = surface.gain * (shifted[i] + shift.rest_ir_px * gradient[i]);
        result.both += seen * predicted;
        result.seen += seen * seen;
        result.predicted += predicted * predicted;
      }
    }
    return result;
  }

  const SensorModel& sensor_;
  const Image<float>& paired_;
  const Reference& reference_;
  const Estimates& estimates_;
  Image<std::uint8_t> marks_;
  float noise_energy_;
};

}  // namespace

void settle_edges(const SensorModel& sensor, const Image<float>& paired, const Reference& reference,
                  Estimates& estimates) {
  const EdgeSettler settler(sensor, paired, reference, estimates);
  struct Settled {
    int x, y;
    std::optional<LocalSurface> surface;
  };
  std::vector<Settled> settled;
  const int border = sensor.matcher.window_columns / 4;
  for (int y = 0; y < sensor.height; ++y)
    for (int x = border; x < sensor.width - border; ++x)
      if (settler.is_edge(x, y)) settled.push_back({x, y, {}});
  // All are judged by what was there before any of them changes.
  parallel_ranges(static_cast<int>(settled.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) settled[i].surface = settler.settle(settled[i].x, settled[i].y);
  });
  for (const Settled& pixel : settled) {
    estimates.disparity(pixel.x, pixel.y) =
        pixel.surface ? pixel.surface->disparity : std::numeric_limits<float>::quiet_NaN();
    estimates.correlation(pixel.x, pixel.y) = pixel.surface ? pixel.surface->correlation : 0.0f;
  }
}

}  // namespace fathom
