// Numbers as the page's script unpacks them: deflated, then in base64.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/json.h"

namespace fathom {

inline Json json_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// {"type": "u8" | "u16" | "i16" | "u32", "deflate": "…"}, little-endian.
Json packed(std::span<const std::uint8_t> values);
Json packed(std::span<const std::uint16_t> values);
Json packed(std::span<const std::int16_t> values);
Json packed(std::span<const std::uint32_t> values);

/// Places [m] in whole steps of one length, fine enough for 16 bits to reach the farthest.
class PlaceCode {
 public:
  /// `farthest` [m]: the greatest coordinate, by amount.
  explicit PlaceCode(double farthest) : step_(std::max(farthest, 1e-3) / 32767.0) {}

  double step() const { return step_; }  ///< [m]
  /// Appends x, y, z.
  void add(const Eigen::Vector3d& place, std::vector<std::int16_t>& to) const {
    for (const double value : place) to.push_back(static_cast<std::int16_t>(std::lround(value / step_)));
  }

 private:
  double step_;
};

}  // namespace fathom
