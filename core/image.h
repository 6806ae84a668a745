// A row-major raster. The first pixel's centre is at (0.5, 0.5).
#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace fathom {

template <class T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T value = T{})
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, value) {
    assert(width >= 0 && height >= 0);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  std::size_t size() const { return pixels_.size(); }

  T& operator()(int x, int y) { return pixels_[index(x, y)]; }
  const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }

  T* row(int y) { return pixels_.data() + static_cast<std::size_t>(y) * width_; }
  const T* row(int y) const { return pixels_.data() + static_cast<std::size_t>(y) * width_; }

  std::span<T> pixels() { return pixels_; }
  std::span<const T> pixels() const { return pixels_; }

 private:
  std::size_t index(int x, int y) const {
    assert(x >= 0 && x < width_ && y >= 0 && y < height_);
    return static_cast<std::size_t>(y) * width_ + x;
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

}  // namespace fathom
