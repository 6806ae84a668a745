#include "sim/sensor/pattern.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/last_made.h"
#include "core/rng.h"
#include "core/simd.h"

namespace fathom {
namespace {

constexpr std::uint64_t kTileStream = 0x74696c65ULL;
constexpr int kUniqueWindow = 9, kUniqueRange = 136, kUniqueCells = 5;

/// Distance of two positions on a ring of `size` places.
int ring_distance(int a, int b, int size) {
  const int straight = std::abs(a - b);
  return std::min(straight, size - straight);
}

/// A tile in the making, with the sums that tell how crowded each place is.
class TileMaker {
 public:
  TileMaker(int columns, int rows, Rng rng) : tile_(columns, rows), crowding_(columns, rows), rng_(rng) {}

  const Image<std::uint8_t>& tile() const { return tile_; }

  int wrapped_x(int x) const { return (x % tile_.width() + tile_.width()) % tile_.width(); }
  int wrapped_y(int y) const { return (y % tile_.height() + tile_.height()) % tile_.height(); }

  bool is_free(int x, int y) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (tile_(wrapped_x(x + dx), wrapped_y(y + dy))) return false;
    return true;
  }

  /// Whether a dot fits here and its image fits there.
  bool can_take_pair(int x, int y) const {
    const int mirror_x = tile_.width() - 1 - x, mirror_y = tile_.height() - 1 - y;
    const bool near_mirror =
        ring_distance(x, mirror_x, tile_.width()) <= 1 && ring_distance(y, mirror_y, tile_.height()) <= 1;
    return !near_mirror && is_free(x, y) && is_free(mirror_x, mirror_y);
  }

  /// Sets or clears a dot and its image under the tile's point symmetry.
  void set_pair(int x, int y, bool on) {
    set(x, y, on);
    const int mirror_x = tile_.width() - 1 - x, mirror_y = tile_.height() - 1 - y;
    if (mirror_x != x || mirror_y != y) set(mirror_x, mirror_y, on);
  }

  /// Adds a pair at the least crowded of a few random free places; false when no free place was found.
  bool add_pair() {
    constexpr int kCandidates = 4, kTries = 4000;
    int best_x = -1, best_y = -1, found = 0;
    for (int attempt = 0; attempt < kTries && found < kCandidates; ++attempt) {
      const int x = static_cast<int>(rng_.below(static_cast<std::uint32_t>(tile_.width())));
      const int y = static_cast<int>(rng_.below(static_cast<std::uint32_t>(tile_.height())));
      if (!can_take_pair(x, y)) continue;
      ++found;
      if (best_x < 0 || crowding_(x, y) < crowding_(best_x, best_y)) best_x = x, best_y = y;
    }
    if (best_x < 0) return false;
    set_pair(best_x, best_y, true);
    return true;
  }

  /// Moves one random dot (and its image) of the window that starts at (x, y) to a free place nearby, so that the
  /// window changes but does not get emptier.
  void move_one(int x, int y) {
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const int from_x = wrapped_x(x + static_cast<int>(rng_.below(kUniqueWindow)));
      const int from_y = wrapped_y(y + static_cast<int>(rng_.below(kUniqueWindow)));
      const int to_x = wrapped_x(x + static_cast<int>(rng_.below(kUniqueWindow)));
      const int to_y = wrapped_y(y + static_cast<int>(rng_.below(kUniqueWindow)));
      const bool at_centre = from_x == tile_.width() - 1 - from_x && from_y == tile_.height() - 1 - from_y;
      if (!tile_(from_x, from_y) || at_centre) continue;
      set_pair(from_x, from_y, false);
      const bool moved = (to_x != from_x || to_y != from_y) && can_take_pair(to_x, to_y);
      set_pair(moved ? to_x : from_x, moved ? to_y : from_y, true);
      if (moved) return;
    }
  }

 private:
  void set(int x, int y, bool on) {
    constexpr int kReach = 4;
    constexpr float kSpread2 = 2.0f * 2.2f * 2.2f;
    tile_(x, y) = on;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const float weight = std::exp(static_cast<float>(-dx * dx - dy * dy) / kSpread2);
        crowding_(wrapped_x(x + dx), wrapped_y(y + dy)) += on ? weight : -weight;
      }
  }

  Image<std::uint8_t> tile_;
  Image<float> crowding_;
  Rng rng_;
};

/// Every size×size window of the repeated tile as bits, by its first column and row; size ≤ 11.
using WindowBits = std::array<std::uint64_t, 2>;
Image<WindowBits> window_bits(const Image<std::uint8_t>& tile, int size) {
  Image<WindowBits> windows(tile.width(), tile.height(), WindowBits{});
  for (int y = 0; y < tile.height(); ++y)
    for (int x = 0; x < tile.width(); ++x)
      for (int cell = 0; cell < size * size; ++cell)
        if (tile((x + cell % size) % tile.width(), (y + cell / size) % tile.height()))
          windows(x, y)[cell / 64] |= std::uint64_t{1} << (cell % 64);
  return windows;
}

/// Calls `visit(x, y, cells)` for every window and every other one to its right within `range`.
template <class Visit>
void compare_windows(const Image<WindowBits>& windows, int range, Visit visit) {
  for (int y = 0; y < windows.height(); ++y)
    for (int x = 0; x < windows.width(); ++x)
      for (int shift = 1; shift <= std::min(range, windows.width() - 1); ++shift) {
        const WindowBits &a = windows(x, y), &b = windows((x + shift) % windows.width(), y);
        visit(x, y, std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]));
      }
}

/// Brightness of the whole grid: tiles that are not alike bright, each with a spot in its middle.
Image<float> tiled(const PatternModel& model) {
  constexpr std::size_t kProjectors = 8;  // frames of a data set take turns among its sensors'
  static LastMade<PatternModel, Image<std::uint8_t>, kProjectors> kept;
  const std::shared_ptr<const Image<std::uint8_t>> made = kept.get(model, [&] { return make_dot_tile(model); });
  const Image<std::uint8_t>& tile = *made;
  Image<float> grid(model.tile_columns * model.tiles_across, model.tile_rows * model.tiles_down);
  for (int down = 0; down < model.tiles_down; ++down)
    for (int across = 0; across < model.tiles_across; ++across) {
      Rng rng(model.seed, kTileStream, across, down);
      const double of_tile = model.tile_spread > 0.0 ? std::max(1.0 + model.tile_spread * rng.normal(), 0.1) : 1.0;
      for (int y = 0; y < model.tile_rows; ++y)
        for (int x = 0; x < model.tile_columns; ++x) {
          if (!tile(x, y)) continue;
          const bool in_middle = x == model.tile_columns / 2 && y == model.tile_rows / 2;
          grid(across * model.tile_columns + x, down * model.tile_rows + y) =
              static_cast<float>(of_tile * (in_middle ? model.zero_order : 1.0));
        }
    }
  return grid;
}

constexpr int kReach = 4;  ///< of a dot that is out of focus [steps]

/// Σ dot · exp(exponent · distance²) over the 2 kReach × 2 kReach dots around a place, which lies by the fractions
/// `across` and `down` of a step beyond the fourth of them.
FATHOM_SIMD_CLONES
float spots_around(const float* dots, int row_length, float across, float down, float exponent) {
  static_assert(2 * kReach == 8);
  constexpr float kLeast = -87.0f;
  const Float8 steps{-3.0f, -2.0f, -1.0f, 0.0f, 1.0f, 2.0f, 3.0f, 4.0f};
  const auto weights = [&](float fraction, Float8& weight) __attribute__((always_inline)) {
    const Float8 off = steps - fraction;
    const Float8 power = exponent * off * off;
    exp8(power > kLeast ? power : Float8{} + kLeast, weight);
  };
  Float8 columns, rows, sums{}, sums_of_lower{};
  weights(across, columns);
  weights(down, rows);
  for (int row = 0; row < kReach; ++row) {
    Float8 upper, lower;
    __builtin_memcpy(&upper, dots + row * row_length, sizeof upper);
    __builtin_memcpy(&lower, dots + (row + kReach) * row_length, sizeof lower);
    sums += rows[row] * upper;
    sums_of_lower += rows[row + kReach] * lower;
  }
  sums += sums_of_lower;
  sums *= columns;
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace

Image<std::uint8_t> make_dot_tile(const PatternModel& model) {
  TileMaker maker(model.tile_columns, model.tile_rows, Rng(model.seed, 0x7061747465726eULL));
  int dots = 0;
  if (model.dots_per_tile % 2 == 1 && model.tile_columns % 2 == 1 && model.tile_rows % 2 == 1) {
    maker.set_pair(model.tile_columns / 2, model.tile_rows / 2, true);
    ++dots;
  }
  for (; dots + 1 < model.dots_per_tile; dots += 2)
    if (!maker.add_pair()) throw Error("pattern", "dots_per_tile", "leaves no room between the dots, lower it");
  constexpr int kRepairs = 60;
  constexpr std::size_t kMostAtOnce = 500;
  for (int repair = 0; repair < kRepairs; ++repair) {
    std::vector<std::pair<int, int>> alike;  // a few windows that do not overlap: one moved dot often mends several
    compare_windows(window_bits(maker.tile(), kUniqueWindow), kUniqueRange, [&](int x, int y, int cells) {
      if (cells >= kUniqueCells || alike.size() >= kMostAtOnce) return;
      const bool apart = std::none_of(alike.begin(), alike.end(), [&](const auto& other) {
        return ring_distance(x, other.first, model.tile_columns) < kUniqueWindow &&
               ring_distance(y, other.second, model.tile_rows) < kUniqueWindow;
      });
      if (apart) alike.emplace_back(x, y);
    });
    if (alike.empty()) return maker.tile();
    for (const auto& [x, y] : alike) maker.move_one(x, y);
  }
  throw Error("pattern", "dots_per_tile", "leaves no pattern with unique 9×9 windows, change it or the tile's size");
}

int least_window_difference(const Image<std::uint8_t>& tile, int size, int range) {
  int least = size * size;
  compare_windows(window_bits(tile, size), range, [&](int, int, int cells) { least = std::min(least, cells); });
  return least;
}

Pattern::Pattern(const PatternModel& model, double ir_px_per_depth_px, double pincushion)
    : permanent_(model.image.brightness ? *model.image.brightness : tiled(model)),
      step_px_(model.step_px),
      sigma_steps_(model.dot_sigma_ir_px / (ir_px_per_depth_px * model.step_px)),
      pincushion_(pincushion) {
  set_dot_gains({});
  for (int i = 0; i <= kTableSize; ++i)
    for (int c = 0; c < 4; ++c) {
      const double steps = (static_cast<double>(i) / kTableSize - (c - 1)) / sigma_steps_;
      profile_[i][c] = static_cast<float>(std::exp(-0.5 * steps * steps));
    }
}

void Pattern::set_dot_gains(std::span<const float> gains) {
  assert(gains.empty() || gains.size() == permanent_.size());
  brightness_ = permanent_;
  for (std::size_t dot = 0; dot < gains.size(); ++dot) brightness_.pixels()[dot] *= gains[dot];
}

double Pattern::intensity(const Eigen::Vector2d& on_grid) const {
  const double column = on_grid.x(), row = on_grid.y();
  if (!(column >= 1.0 && row >= 1.0 && column < columns() - 2 && row < rows() - 2)) return 0.0;
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  const Eigen::Array4f& across = profile_[static_cast<int>((column - left) * kTableSize + 0.5)];
  const Eigen::Array4f& down = profile_[static_cast<int>((row - top) * kTableSize + 0.5)];
  Eigen::Array4f sums = Eigen::Array4f::Zero();
  for (int r = 0; r < 4; ++r) {
    const float* dots = &brightness_(left - 1, top - 1 + r);
    sums += down[r] * Eigen::Map<const Eigen::Array4f>(dots);
  }
  return (across * sums).sum();
}

double Pattern::intensity(const Eigen::Vector2d& on_grid, double blur_steps) const {
  if (blur_steps == 0.0) return intensity(on_grid);
  const double column = on_grid.x(), row = on_grid.y();
  if (!(column >= kReach && row >= kReach && column < columns() - kReach && row < rows() - kReach)) return 0.0;
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  const double sharp = sigma_steps_ * sigma_steps_, per_variance = 1.0 / (sharp + blur_steps * blur_steps);
  const float* dots = &brightness_(left - kReach + 1, top - kReach + 1);
  return sharp * per_variance *
         spots_around(dots, columns(), static_cast<float>(column - left), static_cast<float>(row - top),
                      static_cast<float>(-0.5 * per_variance));
}

double Pattern::mean_intensity() const {
  double sum = 0.0;
  for (const float dot : permanent_.pixels()) sum += dot;
  return 2.0 * std::numbers::pi * sigma_steps_ * sigma_steps_ * sum / static_cast<double>(permanent_.size());
}

Defocus::Defocus(const SensorModel& sensor) {
  const OpticsModel& optics = sensor.optics;
  if (!optics.defocuses()) return;
  const double focal_ir_px = sensor.ir_scale() * sensor.focal_px;
  const double aperture = 1e-6 * optics.pixel_um * focal_ir_px / optics.f_number;  // [m]
  const double steps_per_rad = sensor.focal_px / sensor.pattern.step_px;
  // The standard deviation of an evenly lit disc is a quarter of its diameter.
  if (optics.focus > 0.0) disc_ = 0.25 * aperture * steps_per_rad, focus_dioptres_ = 1.0 / optics.focus;
  beam_ = 0.25 * optics.beam * steps_per_rad;
}

}  // namespace fathom
