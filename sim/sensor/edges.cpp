#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "sim/sensor/match.h"

namespace fathom {
namespace {

constexpr int kReach = 4;  ///< [depth px] a window of 9 whose centre lies this far away just covers the pixel
constexpr int kOwnColumns = 8, kOwnRows = 3;  ///< [infrared px, row pairs] the square that counts as the pixel's own

struct Step {
  int dx, dy;
};
constexpr int kLookout = 4;  ///< [depth px] edges farther away than this do not touch the pixel's window
constexpr std::array<Step, 4> kAcross{{{-kLookout, 0}, {kLookout, 0}, {0, -kLookout}, {0, kLookout}}};
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

class EdgeSettler {
 public:
  EdgeSettler(const SensorModel& sensor, const Image<float>& paired, const Reference& reference,
              const Image<Estimate>& estimates)
      : sensor_(sensor),
        paired_(paired),
        reference_(reference),
        estimates_(estimates),
        edges_(sensor.width, sensor.height),
        noise_energy_(static_cast<float>(sensor.matcher.contrast_min * sensor.matcher.contrast_min) * kOwnColumns *
                      kOwnRows) {
    parallel_ranges(edges_.height(), [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < edges_.width(); ++x) edges_(x, y) = near_edge(x, y);
    });
  }

  /// Whether the windows around the pixel meet more than one surface.
  bool is_edge(int x, int y) const { return edges_(x, y) != 0; }

  Estimate settle(int x, int y) const {
    constexpr float kExplained = 0.5f;
    Estimate best;
    float best_correlation = kExplained;
    const std::vector<Neighbour> neighbours = clean_neighbours(x, y);
    for (Estimate& surface : surfaces_around(x, y)) {
      const bool own = surface.disparity == estimates_(x, y).disparity;
      surface.disparity = from_neighbours(neighbours, surface);
      const Likeness found = likeness(x, y, surface);
      // A pixel without dots, seen or predicted, keeps its own surface but takes no other's.
      if (found.energy() < noise_energy_ && own) return surface;
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
    return x >= border && x < estimates_.width() - border && y >= 0 && y < estimates_.height();
  }

  static float extended(const Estimate& estimate, int dx, int dy) {
    return estimate.disparity + estimate.slope_x * static_cast<float>(dx) + estimate.slope_y * static_cast<float>(dy);
  }

  bool near_edge(int x, int y) const {
    constexpr float kStep = 0.4f;  // [px] of disparity beyond what the slope explains
    constexpr float kDrop = 0.1f;  // of the correlation: foreign dots in this window
    const Estimate& here = estimates_(x, y);
    for (const auto& [dx, dy] : kAcross) {
      if (!inside(x + dx, y + dy)) continue;
      const Estimate& there = estimates_(x + dx, y + dy);
      if (here.valid() != there.valid() || std::fabs(there.disparity - extended(here, dx, dy)) > kStep) return true;
      if (here.correlation < there.correlation - kDrop) return true;
    }
    return false;
  }

  /// The different surfaces that the pixel's own and the neighbouring windows found, extended to the pixel, each from
  /// its best correlated window.
  std::vector<Estimate> surfaces_around(int x, int y) const {
    constexpr float kDifferent = 0.6f;  // [px]
    std::vector<Estimate> surfaces;
    for (const auto& [dx, dy] : kAround) {
      if (!inside(x + dx, y + dy) || !estimates_(x + dx, y + dy).valid()) continue;
      Estimate found = estimates_(x + dx, y + dy);
      found.disparity = extended(found, -dx, -dy);
      const auto same = std::find_if(surfaces.begin(), surfaces.end(), [&](const Estimate& other) {
        return std::fabs(other.disparity - found.disparity) < kDifferent;
      });
      if (same == surfaces.end())
        surfaces.push_back(found);
      else if (found.correlation > same->correlation)
        *same = found;
    }
    return surfaces;
  }

  struct Neighbour {
    float dx, dy, disparity;
  };

  /// Those neighbours whose windows meet one surface only: windows that reach over an edge are pulled by the other
  /// surface's dots.
  std::vector<Neighbour> clean_neighbours(int x, int y) const {
    constexpr int kFar = 8, kStride = 2;
    std::vector<Neighbour> neighbours;
    for (int dy = -kFar; dy <= kFar; dy += kStride)
      for (int dx = -kFar; dx <= kFar; dx += kStride)
        if (inside(x + dx, y + dy) && !is_edge(x + dx, y + dy) && estimates_(x + dx, y + dy).valid())
          neighbours.push_back({static_cast<float>(dx), static_cast<float>(dy), estimates_(x + dx, y + dy).disparity});
    return neighbours;
  }

  /// A surface's disparity at the pixel from the plane through its clean neighbours; its own where they are too few.
  static float from_neighbours(const std::vector<Neighbour>& neighbours, Estimate surface) {
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
    return surface.disparity;
  }

  Likeness likeness(int x, int y, const Estimate& surface) const {
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
  const Image<Estimate>& estimates_;
  Image<std::uint8_t> edges_;
  float noise_energy_;
};

}  // namespace

void settle_edges(const SensorModel& sensor, const Image<float>& paired, const Reference& reference,
                  Image<Estimate>& estimates) {
  const EdgeSettler settler(sensor, paired, reference, estimates);
  struct Settled {
    int x, y;
    Estimate estimate;
  };
  std::vector<Settled> settled;
  const int border = sensor.matcher.window_columns / 4;
  for (int y = 0; y < sensor.height; ++y)
    for (int x = border; x < sensor.width - border; ++x)
      if (settler.is_edge(x, y)) settled.push_back({x, y, {}});
  // All are judged by what was there before any of them changes.
  parallel_ranges(static_cast<int>(settled.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) settled[i].estimate = settler.settle(settled[i].x, settled[i].y);
  });
  for (const Settled& pixel : settled) estimates(pixel.x, pixel.y) = pixel.estimate;
}

}  // namespace fathom
