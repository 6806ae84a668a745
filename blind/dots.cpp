// The pattern of dots.
#include <cstdint>

#include "blind/follow.h"
#include "core/rng.h"

namespace fathom::blind {
namespace {

constexpr int kWidth = 211, kHeight = 165, kDots = 3861;
constexpr int kTilesAcross = 5;  // numbers of dots: what any sensor's image can meet

/// Darts at random positions; one that would touch another, the neighbouring tiles' as well, is thrown again.
std::vector<std::uint8_t> throw_darts() {
  std::vector<std::uint8_t> lit(static_cast<std::size_t>(kWidth) * kHeight, 0);
  const auto at = [&](int x, int y) -> std::uint8_t& {
    return lit[static_cast<std::size_t>((y + kHeight) % kHeight) * kWidth + (x + kWidth) % kWidth];
  };
  Rng rng(0xd075);
  for (int dots = 0; dots < kDots;) {
    const int x = static_cast<int>(rng.below(kWidth)), y = static_cast<int>(rng.below(kHeight));
    bool is_free = true;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) is_free = is_free && !at(x + dx, y + dy);
    if (!is_free) continue;
    at(x, y) = 1;
    ++dots;
  }
  return lit;
}

int wrapped(int value, int period) { return ((value % period) + period) % period; }

}  // namespace

std::vector<Dot> dots_in(const Eigen::Vector2i& low, const Eigen::Vector2i& high) {
  static const std::vector<std::uint8_t> lit = throw_darts();
  std::vector<Dot> dots;
  for (int y = low.y(); y < high.y(); ++y)
    for (int x = low.x(); x < high.x(); ++x)
      if (lit[static_cast<std::size_t>(wrapped(y, kHeight)) * kWidth + wrapped(x, kWidth)])
        dots.push_back({{x + 0.5, y + 0.5}, (y + 4 * kHeight) * (kTilesAcross * kWidth) + x + kWidth});
  return dots;
}

}  // namespace fathom::blind
