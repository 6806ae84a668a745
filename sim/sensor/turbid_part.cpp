#include "sim/sensor/turbid_part.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "core/rng.h"
#include "core/timed.h"
#include "sim/sensor/window_sums.h"

namespace fathom {
namespace {

constexpr std::uint64_t kPartStream = 0x74757262ULL;

/// What a match may read to each side of its pixel: its own window, and those of the neighbours that tell edges from
/// slopes.
int reach_of_match(const MatcherModel& matcher) { return 2 * std::max(matcher.window_columns, matcher.window_rows); }

/// Bounds of what is seen of one liquid.
struct Bounds {
  int left, top, right, bottom;

  void add(int x, int y) {
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
};

std::map<int, Bounds> seen_liquids(const Image<TruePixel>& truth) {
  std::map<int, Bounds> liquids;
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x)
      if (truth(x, y).path == PathKind::scattered)
        liquids.try_emplace(truth(x, y).object, Bounds{x, y, x, y}).first->second.add(x, y);
  return liquids;
}

/// With room to match all of it. It starts where a tile of the matcher starts, so that each pixel is matched as in the
/// whole image.
ImagePart part_around(const Bounds& bounds, const SensorModel& sensor) {
  const int reach = reach_of_match(sensor.matcher);
  const int left = std::max(bounds.left - reach, 0) / kTileColumns * kTileColumns;
  const int top = std::max(bounds.top - reach, 0) / kTileRows * kTileRows;
  return {left, top, std::min(bounds.right + 1 + reach, sensor.width) - left,
          std::min(bounds.bottom + 1 + reach, sensor.height) - top};
}

}  // namespace

SensorModel sensor_of_part(const SensorModel& sensor, const ImagePart& part) {
  SensorModel of_part = sensor;
  const int scale = static_cast<int>(sensor.ir_scale());
  of_part.width = part.width, of_part.height = part.height;
  of_part.ir_width = part.width * scale, of_part.ir_height = part.height * scale;
  of_part.principal_px -= Eigen::Vector2d(part.left, part.top);
  of_part.unit = {};
  return of_part;
}

std::map<int, ImagePart> parts_with_liquids(const Image<TruePixel>& truth, const SensorModel& sensor) {
  std::map<int, ImagePart> parts;
  for (const auto& [object, bounds] : seen_liquids(truth)) parts.emplace(object, part_around(bounds, sensor));
  return parts;
}

TurbidPart::TurbidPart(const ImagePart& part, ImagedView view, int object)
    : part_(part), view_(std::move(view)), object_(object) {}

void TurbidPart::shoot(std::uint64_t frame, const Image<TruePixel>& truth, Image<float>& disparity_px,
                       CaptureStatistics& statistics) const {
  const Image<float> matched = view_.shoot(frame, statistics).disparity_px;
  for (int y = 0; y < part_.height; ++y)
    for (int x = 0; x < part_.width; ++x) {
      const TruePixel& pixel = truth(part_.left + x, part_.top + y);
      if (pixel.path == PathKind::scattered && pixel.object == object_)
        disparity_px(part_.left + x, part_.top + y) = matched(x, y);
    }
}

std::vector<TurbidPart> turbid_parts(const PointLight& projector, const Rig& rig, const Image<TruePixel>& truth,
                                     int samples_across, std::uint64_t seed, CaptureStatistics& statistics) {
  std::vector<TurbidPart> parts;
  const SensorModel& sensor = rig.sensor;
  const std::map<int, ImagePart> with_liquids = parts_with_liquids(truth, sensor);
  if (with_liquids.empty()) return parts;
  const Pattern pattern(sensor.pattern, sensor.ir_scale(), sensor.optics.projector_k1);
  Pattern lit = pattern;
  lit.set_dot_gains(speckle_gains(sensor.noise, pattern, seed));
  for (const auto& [object, part] : with_liquids) {
    const Rig of_part{sensor_of_part(sensor, part), rig.world_from_camera};
    const auto reference = timed(statistics.reference_s, [&] {
      return std::make_shared<const Reference>(remember(of_part.sensor, pattern, samples_across));
    });
    const std::uint64_t own_seed = mix_bits(seed ^ (kPartStream + static_cast<std::uint64_t>(object)));
    ImagedView view(projector, of_part, lit, reference, samples_across, LightModel::scattered, own_seed, statistics);
    parts.emplace_back(part, std::move(view), object);
  }
  return parts;
}

}  // namespace fathom
