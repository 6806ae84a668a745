#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"
#include "sim/sensor/dot_likeness.h"
#include "sim/sensor/match.h"
#include "sim/sensor/surface_fit.h"

namespace fathom {
namespace {

constexpr int kReach = 4;  ///< [depth px] a window of 9 whose centre lies this far away just covers the pixel

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

/// A surface that was found near a pixel, extended to the pixel.
struct CandidateSurface {
  LocalSurface surface;
  float correlation;     ///< of the window that found it
  bool own;              ///< whether the pixel's own window found it too
  float least_likeness;  ///< of the pixel's dots, for it to be taken
};

// What the pixel's window found is believed unless its dots deny it; chance alone correlates 24 samples by 0.2.
constexpr float kOwnLikeness = 0.0f, kOthersLikeness = 0.3f;

/// Says of the pixels of a row what their windows meet. An edge: the disparity over ±kReach is far from straight, or
/// much more is left unexplained than in a neighbour's window, because of foreign dots. A crease: it bends. `clean`
/// gets the disparities of the other windows, which meet one straight surface, and NaN for these.
FATHOM_SIMD_CLONES
void mark_surroundings(const float* disparity, const float* correlation, std::ptrdiff_t stride, std::uint8_t* edge,
                       float* clean, int begin, int end) {
  constexpr float kBreak = 0.8f;    // [px]
  constexpr float kBend = 0.2f;     // [px]; 2 to 3 times the noise of such a difference
  constexpr float kAsGood = 0.02f;  // of a correlation
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
    edge[x] = !whole;
    clean[x] = (whole & straight & (c[0] > best - kAsGood)) ? d[0] : std::numeric_limits<float>::quiet_NaN();
  }
}

class EdgeSettler {
 public:
  EdgeSettler(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference,
              const Image<float>& coarse, const Estimates& estimates)
      : sensor_(sensor),
        paired_(paired),
        reference_(reference),
        coarse_(coarse),
        estimates_(estimates),
        border_(sensor.matcher.window_columns / 4),
        edge_(sensor.width, sensor.height),
        clean_(sensor.width + 2 * kFrame, sensor.height + 2 * kFrame, std::numeric_limits<float>::quiet_NaN()),
        noise_energy_(static_cast<float>(sensor.matcher.contrast_min * sensor.matcher.contrast_min) * kDotColumns *
                      kDotRows) {
    parallel_rows(sensor.height, [&](int y) { mark_row(y); });
  }

  /// The first pixel from x on in its row whose windows meet more than one surface; the row's width when there is none.
  int next_edge(int x, int y) const {
    const std::uint8_t* row = edge_.row(y);
    const void* const found = std::memchr(row + x, 1, static_cast<std::size_t>(edge_.width() - x));
    return found ? static_cast<int>(static_cast<const std::uint8_t*>(found) - row) : edge_.width();
  }

  /// The surface whose dots are most like those at the pixel; nothing when none is.
  std::optional<CandidateSurface> settle(int x, int y) const {
    std::optional<CandidateSurface> best;
    float best_correlation = -1.0f;
    Candidates candidates = candidates_around(x, y);
    if (candidates.empty()) return best;
    const Neighbours neighbours = neighbours_of(clean_, x, y);
    for (CandidateSurface& candidate : candidates) {
      fit(neighbours, candidate.surface);
      const Likeness found = dot_likeness(sensor_, paired_, reference_, x, y, candidate.surface.disparity);
      // A pixel without dots keeps its own surface but takes no other's.
      if (found.contrast < noise_energy_ && candidate.own) return candidate;
      if (found.contrast < noise_energy_ || found.correlation < std::max(best_correlation, candidate.least_likeness))
        continue;
      best_correlation = found.correlation;
      best = candidate;
    }
    return best;
  }

 private:
  static constexpr int kFrame = Neighbours::kReach;

  void mark_row(int y) {
    const int width = edge_.width();
    const float* disparity = estimates_.disparity.row(y);
    float* clean = clean_.row(y + kFrame) + kFrame;
    // The image's own border is no edge between surfaces.
    std::copy_n(disparity, width, clean);
    const int margin = border_ + kReach;
    if (y < kReach || y >= edge_.height() - kReach) return;
    mark_surroundings(disparity, estimates_.correlation.row(y), width, edge_.row(y), clean, margin, width - margin);
  }

  /// Inside the image and not in its border, where nothing is matched.
  bool inside(int x, int y) const {
    return x >= border_ && x < edge_.width() - border_ && y >= 0 && y < edge_.height();
  }

  /// In place: edges are settled a hundred thousand times a frame.
  using Candidates = boost::container::static_vector<CandidateSurface, kAround.size() + 1>;

  /// The different surfaces that the pixel's own and the neighbouring windows found, each from its best correlated
  /// window. Where the pixel's own found nothing there is still what was searched, on a steep wall say; far from all
  /// the others it is chance.
  Candidates candidates_around(int x, int y) const {
    constexpr float kJoined = 4.0f;  // [px]
    Candidates candidates;
    for (const auto& [dx, dy] : kAround) {
      const int i = x + dx, j = y + dy;
      if (!inside(i, j) || !estimates_.valid(i, j)) continue;
      LocalSurface surface{estimates_.disparity(i, j), estimates_.slope_x(i, j), estimates_.slope_y(i, j)};
      surface.disparity -= surface.slope_x * static_cast<float>(dx) + surface.slope_y * static_cast<float>(dy);
      const bool own = dx == 0 && dy == 0;
      propose({surface, estimates_.correlation(i, j), own, own ? kOwnLikeness : kOthersLikeness}, candidates);
    }
    if (estimates_.valid(x, y)) return candidates;
    const float searched = coarse_(x / 2, y / kSearchStep);
    const bool joined = std::any_of(candidates.begin(), candidates.end(), [&](const CandidateSurface& other) {
      return std::fabs(other.surface.disparity - searched) < kJoined;
    });
    if (joined) propose({{searched, 0.0f, 0.0f}, 0.0f, false, kOthersLikeness}, candidates);
    return candidates;
  }

  static void propose(const CandidateSurface& found, Candidates& candidates) {
    constexpr float kDifferent = 0.6f;  // [px]
    const auto same = std::find_if(candidates.begin(), candidates.end(), [&](const CandidateSurface& other) {
      return std::fabs(other.surface.disparity - found.surface.disparity) < kDifferent;
    });
    if (same == candidates.end())
      candidates.push_back(found);
    else if (found.correlation > same->correlation)
      same->surface = found.surface, same->correlation = found.correlation;
  }

  const SensorModel& sensor_;
  const SplitColumns<float>& paired_;
  const Reference& reference_;
  const Image<float>& coarse_;
  const Estimates& estimates_;
  int border_;
  Image<std::uint8_t> edge_;  ///< 1 where windows meet more than one surface
  Image<float> clean_;        ///< disparities of the windows that meet one straight surface, framed; else NaN
  float noise_energy_;
};

}  // namespace

void settle_edges(const SensorModel& sensor, const SplitColumns<float>& paired, const Reference& reference,
                  const Image<float>& coarse, Estimates& estimates) {
  const EdgeSettler settler(sensor, paired, reference, coarse, estimates);
  struct Settled {
    int x, y;
    float disparity, correlation;
  };
  // All are judged by what was there before any of them changes.
  std::vector<std::vector<Settled>> settled(sensor.height);
  parallel_rows(sensor.height, [&](int y) {
    for (int x = settler.next_edge(0, y); x < sensor.width; x = settler.next_edge(x + 1, y)) {
      const std::optional<CandidateSurface> best = settler.settle(x, y);
      settled[y].push_back({x, y, best ? best->surface.disparity : std::numeric_limits<float>::quiet_NaN(),
                            best ? best->correlation : 0.0f});
    }
  });
  for (const std::vector<Settled>& row : settled)
    for (const Settled& pixel : row) {
      estimates.disparity(pixel.x, pixel.y) = pixel.disparity;
      estimates.correlation(pixel.x, pixel.y) = pixel.correlation;
    }
}

}  // namespace fathom
