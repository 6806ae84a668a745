#include "datasets/frame_picture.h"

#include "report/depth_picture.h"

namespace fathom {
namespace {

constexpr Rgb kCup{90, 200, 90}, kThing{100, 140, 230}, kSeenThrough{60, 220, 230}, kSurface{250, 160, 50};

/// Colours of what is seen, black where it is the desk or nothing.
Image<Rgb> tints(int width, int height, const std::vector<InstanceLabel>& labels) {
  Image<Rgb> tint(width, height, Rgb{0, 0, 0});
  const auto paint = [&](const Image<std::uint8_t>& mask, const Rgb& colour) {
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (mask.pixels()[i]) tint.pixels()[i] = colour;
  };
  for (const InstanceLabel& label : labels) {
    paint(label.visible, label.model->is_cup ? kCup : kThing);
    if (label.liquid) paint(label.liquid->mask, label.liquid->is_turbid ? kSurface : kSeenThrough);
  }
  return tint;
}

}  // namespace

Image<Rgb> frame_picture(const Frame& frame, const std::vector<InstanceLabel>& labels) {
  const Image<Rgb> grey = depth_picture(frame.depth);
  const Image<Rgb> tint = tints(grey.width(), grey.height(), labels);
  Image<Rgb> picture(grey.width() / 2, grey.height() / 2);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb &shade = grey(2 * x, 2 * y), &colour = tint(2 * x, 2 * y);
      const bool is_labelled = colour != Rgb{0, 0, 0};
      for (std::size_t c = 0; c < 3; ++c)
        picture(x, y)[c] = is_labelled ? static_cast<std::uint8_t>(0.45 * shade[c] + 0.55 * colour[c]) : shade[c];
    }
  return picture;
}

}  // namespace fathom
