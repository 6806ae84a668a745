#include "blind/block_mean.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "blind/device_law.h"
#include "core/rng.h"

namespace fathom::blind {
namespace {

constexpr double kAgreePx = 0.6;  // dots whose correlation peaks overlap
constexpr int kFewestDots = 3;
constexpr double kAgreeingShare = 0.5;
constexpr double kDarkest = 0.05;  // beside the desk: below it no contrast is left

/// Dots by the pixel that they fall into.
class Bins {
 public:
  Bins(const std::vector<SeenDot>& dots, const Raster& raster, int margin)
      : low_(raster.low.array() - margin), size_(raster.high - raster.low + Eigen::Vector2i::Constant(2 * margin)) {
    first_.assign(static_cast<std::size_t>(size_.x()) * size_.y(), -1);
    next_.assign(dots.size(), -1);
    for (int i = 0; i < static_cast<int>(dots.size()); ++i) {
      const Eigen::Vector2i cell = dots[i].pixel.array().floor().matrix().cast<int>() - low_;
      if ((cell.array() < 0).any() || (cell.array() >= size_.array()).any()) continue;
      next_[i] = first_[index(cell)];
      first_[index(cell)] = i;
    }
  }

  /// Calls visit(i) for every dot in the pixels within `half` of a pixel.
  template <class Visit>
  void each(const Eigen::Vector2i& pixel, int half, const Visit& visit) const {
    const Eigen::Vector2i from = (pixel - low_).array() - half, to = (pixel - low_).array() + half;
    for (int y = std::max(0, from.y()); y <= std::min(size_.y() - 1, to.y()); ++y)
      for (int x = std::max(0, from.x()); x <= std::min(size_.x() - 1, to.x()); ++x)
        for (int i = first_[index({x, y})]; i >= 0; i = next_[i]) visit(i);
  }

 private:
  std::size_t index(const Eigen::Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * size_.x() + cell.x();
  }
  Eigen::Vector2i low_, size_;
  std::vector<int> first_, next_;
};

/// Only dots of the middle rows pass their errors on, or all where there are none.
void share_errors(Matched& matched, const Block& block) {
  constexpr double kRows = 2.0;  // on either side
  const auto is_near = [&](const Member& member) {
    return std::abs(matched.dots[member.dot].pixel.y() - block.pixel.y()) <= kRows;
  };
  double near = 0.0;
  for (int k = block.first; k < block.first + block.count; ++k)
    if (is_near(matched.members[k])) near += matched.members[k].weight;
  for (int k = block.first; k < block.first + block.count; ++k) {
    Member& member = matched.members[k];
    member.error_weight = near == 0.0 ? member.weight : is_near(member) ? member.weight / near : 0.0;
  }
}

/// The largest group of dots in a window that agree on a disparity becomes the block; without one nothing is added.
void correlate(const std::vector<int>& inside, const std::vector<double>& grain, const Eigen::Vector2i& pixel,
               Matched& matched) {
  const std::vector<SeenDot>& dots = matched.dots;
  const auto light = [&](int i) { return dots[i].brightness * grain[i]; };
  double best = 0.0, all = 0.0, middle = 0.0;
  for (const int i : inside) {
    double agreeing = 0.0;
    for (const int j : inside)
      if (std::abs(dots[i].disparity_px - dots[j].disparity_px) <= kAgreePx) agreeing += light(j);
    if (agreeing > best) best = agreeing, middle = dots[i].disparity_px;
    all += light(i);
  }
  if (best < kAgreeingShare * all || best <= 0.0) return;
  Block block{
      .pixel = pixel.cast<double>().array() + 0.5, .light = best, .first = static_cast<int>(matched.members.size())};
  std::array<double, 6> on{};
  for (const int i : inside) {
    if (std::abs(dots[i].disparity_px - middle) > kAgreePx) continue;
    const double weight = light(i) / best;
    matched.members.push_back({i, weight, 0.0});
    block.disparity_px += weight * dots[i].disparity_px;
    block.brightness += weight * light(i);
    on[static_cast<int>(dots[i].lit)] += weight;
    ++block.count;
  }
  if (block.count < kFewestDots || block.brightness < kDarkest) {
    matched.members.resize(block.first);
    return;
  }
  share_errors(matched, block);
  block.lit = static_cast<Lit>(std::max_element(on.begin(), on.end()) - on.begin());
  matched.blocks.push_back(block);
}

}  // namespace

Matched match(const World& world, const std::vector<Dot>& dots, bool has_cup, const Raster& raster,
              std::uint64_t speckle) {
  Matched matched;
  matched.dots.reserve(dots.size());
  const Eyes eyes = eyes_of(world.sensor);
  for (const Dot& dot : dots) follow(world, eyes, dot, has_cup, matched.dots);
  std::vector<double> grain;
  grain.reserve(matched.dots.size());
  for (SeenDot& dot : matched.dots) {
    // Landau 2016: Gamma(4.54, 0.196).
    grain.push_back(Rng(speckle, dot.number).gamma(4.54, 0.196));
    matched.dot_sigma.push_back(std::sqrt(0.7 + 0.3 / std::max(0.05, dot.brightness)));
    dot.disparity_px += world.dust.bright_px * std::log2(std::max(0.05, dot.brightness));
  }
  const int half = world.sensor.window_px / 2;
  const Bins bins(matched.dots, raster, half);
  std::vector<int> inside;
  for (int y = raster.low.y(); y < raster.high.y(); y += raster.stride)
    for (int x = raster.low.x(); x < raster.high.x(); x += raster.stride) {
      inside.clear();
      bins.each({x, y}, half, [&](int i) { inside.push_back(i); });
      correlate(inside, grain, {x, y}, matched);
    }
  return matched;
}

std::vector<Dot> dots_for(const Sensor& sensor, const Raster& raster, double near, double far) {
  const int half = sensor.window_px / 2 + 8;  // wide enough for units whose axis and focal length are off
  const int most = static_cast<int>(disparity_of(near)) + half, least = static_cast<int>(disparity_of(far)) - half;
  return dots_in({raster.low.x() - most, raster.low.y() - half}, {raster.high.x() - least, raster.high.y() + half});
}

std::vector<float> infrared_dn(const Matched& matched) {
  constexpr double kPeakDn = 188.0, kSigmaPx = 0.6;
  std::vector<float> dn;
  dn.reserve(matched.blocks.size());
  for (const Block& block : matched.blocks) {
    double sum = 0.0;
    for (int k = block.first; k < block.first + block.count; ++k) {
      const SeenDot& dot = matched.dots[matched.members[k].dot];
      sum +=
          matched.members[k].weight * std::exp(-0.5 * (dot.pixel - block.pixel).squaredNorm() / (kSigmaPx * kSigmaPx));
    }
    dn.push_back(static_cast<float>(std::min(1023.0, kPeakDn * block.light * sum)));
  }
  return dn;
}

}  // namespace fathom::blind
