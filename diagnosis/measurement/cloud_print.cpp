#include "diagnosis/measurement/cloud_print.h"

#include <bit>

#include "core/rng.h"

namespace fathom {

CloudPrint print_of(std::span<const SensedPoint> points, double focal_px) {
  constexpr int kColumns = 4, kRows = 3;  // a cup with its shadow stands in few of them
  constexpr int kFewest = 100;            // fewer noisy depths of whole steps may be alike by chance
  CloudPrint print;
  std::array<int, std::tuple_size_v<decltype(print.parts)>> counts{};
  for (const SensedPoint& sensed : points) {
    const auto depth = std::bit_cast<std::uint32_t>(sensed.point.z());
    const std::size_t part = part_of_image(sensed.point, focal_px, kColumns, kRows);
    print.whole = mix_bits(print.whole ^
                           (static_cast<std::uint64_t>(depth) << 32 | std::bit_cast<std::uint32_t>(sensed.intensity)));
    print.parts[part] = mix_bits(print.parts[part] ^ depth);
    ++counts[part];
  }
  for (std::size_t part = 0; part < counts.size(); ++part)
    if (counts[part] < kFewest) print.parts[part] = 0;
  return print;
}

}  // namespace fathom
