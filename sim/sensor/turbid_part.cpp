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

/// [px] What a match may read to each side of its pixel: windows, the slopes of their neighbours and what tells edges
/// from slopes, and the hole that it is filled over.
int reach_of_match(const MatcherModel& matcher) {
  constexpr int kOfRefinement = 24;  // its windows, slopes and neighbours have sizes of their own
  return std::max(2 * std::max(matcher.window_columns, matcher.window_rows), kOfRefinement) + matcher.hole_max_px;
}

/// Bounds of what is seen of one liquid.
struct Bounds {
  int left, top, right, bottom;

  void add(int x, int y) {
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
};

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
  // At the image's upper and lower side windows reach into infrared rows beyond the depth image.
  if (part.top == 0 || part.top + part.height == sensor.height)
    of_part.ir_height += sensor.ir_height - sensor.height * scale;
  of_part.principal_px -= Eigen::Vector2d(part.left, part.top);
  of_part.unit = {};
  of_part.unit.serial = Rng(sensor.unit.serial, kPartStream, part.left, part.top).bits();  // its reference's speckle
  return of_part;
}

std::map<int, ImagePart> parts_with_liquids(const Image<TruePixel>& truth, const SensorModel& sensor) {
  std::map<int, Bounds> liquids;
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x)
      if (truth(x, y).path == PathKind::scattered)
        liquids.try_emplace(truth(x, y).object, Bounds{x, y, x, y}).first->second.add(x, y);
  std::map<int, ImagePart> parts;
  for (const auto& [object, bounds] : liquids) parts.emplace(object, part_around(bounds, sensor));
  return parts;
}

TurbidPart::TurbidPart(const ImagePart& part, ImagedView view, int object)
    : part_(part), view_(std::move(view)), object_(object) {}

Image<float> TurbidPart::match(std::uint64_t frame, CaptureStatistics& statistics) const {
  return view_.shoot(frame, statistics).disparity_px;
}

void TurbidPart::put(const Image<float>& matched_px, const Image<TruePixel>& truth, Image<float>& disparity_px) const {
  for (int y = 0; y < part_.height; ++y)
    for (int x = 0; x < part_.width; ++x) {
      const TruePixel& pixel = truth(part_.left + x, part_.top + y);
      if (pixel.path == PathKind::scattered && pixel.object == object_)
        disparity_px(part_.left + x, part_.top + y) = matched_px(x, y);
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
    const std::uint64_t own_seed = Rng(seed, kPartStream, static_cast<std::uint64_t>(object)).bits();
    ImagedView view(projector, of_part, lit, reference, samples_across, LightModel::scattered, own_seed, statistics);
    parts.emplace_back(part, std::move(view), object);
  }
  return parts;
}

}  // namespace fathom
