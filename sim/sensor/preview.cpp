#include "sim/sensor/preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace fathom {
namespace {

using Colour = std::array<double, 3>;

Rgb rgb(const Colour& colour) {
  Rgb result;
  for (int i = 0; i < 3; ++i)
    result[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(colour[i], 0.0, 1.0)));
  return result;
}

/// Linear interpolation between evenly spaced colours, t in 0 … 1.
template <std::size_t N>
Rgb along(const std::array<Colour, N>& colours, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (N - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), N - 2);
  const double share = at - static_cast<double>(i);
  Colour mixed;
  for (int c = 0; c < 3; ++c) mixed[c] = (1.0 - share) * colours[i][c] + share * colours[i + 1][c];
  return rgb(mixed);
}

/// Near is warm and bright, far is cold and dark.
Rgb depth_colour(double t) {
  constexpr std::array<Colour, 5> kColours{
      {{1.0, 0.93, 0.55}, {0.98, 0.60, 0.25}, {0.80, 0.25, 0.35}, {0.40, 0.12, 0.48}, {0.08, 0.05, 0.25}}};
  return along(kColours, t);
}

Rgb error_colour(double error_m) {
  constexpr std::array<Colour, 3> kColours{{{0.10, 0.35, 0.85}, {1.0, 1.0, 1.0}, {0.85, 0.15, 0.15}}};
  constexpr double kFullScale = 0.005;
  return along(kColours, 0.5 + 0.5 * error_m / kFullScale);
}

/// Without the thousandth at either end: pixels that look along an edge or into a glint would leave one colour to the
/// rest.
struct Scale {
  double low = 0.0, high = 0.0;

  explicit Scale(std::vector<double> values) {
    if (values.empty()) return;
    std::sort(values.begin(), values.end());
    const std::size_t cut = values.size() / 1000;
    low = values[cut], high = values[values.size() - 1 - cut];
  }
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.0; }
};

constexpr Rgb kNoDepth{0, 0, 0};
constexpr Rgb kNotExpected{96, 96, 96};

}  // namespace

Image<Rgb> preview(const Frame& frame, const Image<TruePixel>& truth) {
  const int width = truth.width(), height = truth.height();
  std::vector<double> depths, intensities{0.0};
  for (const TruePixel& pixel : truth.pixels())
    if (pixel.apparent_depth) depths.push_back(*pixel.apparent_depth);
  for (const CloudPoint& point : frame.cloud.pixels()) intensities.push_back(point.intensity);
  const Scale near_to_far(std::move(depths));
  const double brightest = std::max(Scale(std::move(intensities)).high, 1.0);

  Image<Rgb> picture(2 * width, 2 * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double depth = frame.depth(x, y);
      const std::optional<double>& expected = truth(x, y).apparent_depth;
      const double share = std::clamp(frame.cloud(x, y).intensity / brightest, 0.0, 1.0);
      const double grey = std::sqrt(share);  // lifts the dark parts
      picture(x, y) = rgb({grey, grey, grey});
      picture(width + x, y) = depth > 0.0 ? depth_colour(near_to_far.share(depth)) : kNoDepth;
      picture(x, height + y) = expected ? depth_colour(near_to_far.share(*expected)) : kNoDepth;
      picture(width + x, height + y) = !expected      ? kNotExpected
                                       : depth <= 0.0 ? kNoDepth
                                                      : error_colour(depth - *expected);
    }
  return picture;
}

}  // namespace fathom
