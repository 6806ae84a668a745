#include "sim/sensor/bloom.h"

#include <algorithm>
#include <cstddef>

namespace fathom {
namespace {

/// Convolves `count` values, `stride` apart, with a two-sided exponential of unit sum: a recursion to the right, and
/// one to the left, which share the middle.
void spread(float* values, int count, std::ptrdiff_t stride, float decay, std::vector<float>& right) {
  const float norm = (1.0f - decay) / (1.0f + decay);
  float sum = 0.0f;
  for (int i = 0; i < count; ++i) right[i] = sum = values[i * stride] + decay * sum;
  sum = 0.0f;  // of what lies to the right, without the middle
  for (int i = count - 1; i >= 0; --i) {
    const float own = values[i * stride];
    values[i * stride] = norm * (right[i] + sum);
    sum = decay * (sum + own);
  }
}

}  // namespace

void bloom(double full_scale, double share, double reach, Image<float>& image) {
  const auto limit = static_cast<float>(full_scale), spilled = static_cast<float>(share);
  const auto above = [&](float value) { return value > limit; };
  if (spilled == 0.0f || std::none_of(image.pixels().begin(), image.pixels().end(), above)) return;
  Image<float> spill(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    spill.pixels()[i] = spilled * std::max(image.pixels()[i] - limit, 0.0f);
    image.pixels()[i] -= spill.pixels()[i];
  }
  const auto decay = static_cast<float>(reach / (1.0 + reach));
  std::vector<float> right(std::max(image.width(), image.height()));
  for (int y = 0; y < image.height(); ++y) spread(spill.row(y), image.width(), 1, decay, right);
  for (int x = 0; x < image.width(); ++x) spread(&spill(x, 0), image.height(), image.width(), decay, right);
  for (std::size_t i = 0; i < image.size(); ++i) image.pixels()[i] += spill.pixels()[i];
}

}  // namespace fathom
