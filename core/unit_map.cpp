#include "core/unit_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/image_file.h"
#include "core/input_policy.h"
#include "core/json.h"

namespace fathom {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr float kMost_px = 4.0f;  ///< as of other errors of a unit

Image<float> channel_of(const std::string& file, const std::string& name) {
  Image<float> image = read_exr_channel(file, name);
  if (image.width() != kWidth || image.height() != kHeight)
    throw Error(file,
                fmt::format("is {} × {} pixels, must be {} × {}", image.width(), image.height(), kWidth, kHeight));
  for (const float value : image.pixels())
    if (!(std::abs(value) <= kMost_px))
      throw Error(file, name, fmt::format("must hold numbers from {:g} to {:g}, got {:g}", -kMost_px, kMost_px, value));
  return image;
}

bool is_same(const Image<float>& a, const Image<float>& b) { return std::ranges::equal(a.pixels(), b.pixels()); }

}  // namespace

float UnitMap::reference_of(double column_px, double row_px) const {
  const auto within = [](double at, int size) { return static_cast<int>(std::clamp(at, 0.0, size - 1.0)); };
  return reference(within(column_px + reference_at, kWidth), within(row_px, kHeight));
}

float UnitMap::camera_of(int column, int row) const {
  return camera(std::clamp(column, 0, kWidth - 1), std::clamp(row, 0, kHeight - 1));
}

bool UnitMap::operator==(const UnitMap& other) const {
  return reference_at == other.reference_at && is_same(reference, other.reference) && is_same(camera, other.camera);
}

bool LearnedUnit::operator==(const LearnedUnit& other) const {
  return map == other.map || (map && other.map && *map == *other.map);
}

LearnedUnit learned_unit_from_json(const JsonReader& json) {
  return read_learned_unit(path_named_in(json.file(), json.pointer(), json.text()));
}

LearnedUnit read_learned_unit(const std::filesystem::path& file) {
  LearnedUnit learned;
  learned.file = file.string();
  const Json value = read_json(learned.file);
  const JsonReader unit(value, learned.file);
  unit.allow_only({"source", "device", "bias", "prior", "noise", "depths", "warm_up"});
  const JsonReader bias = unit.at("bias");
  bias.allow_only({"image", "reference_at_px", "left_px", "without_px", "poses"});
  learned.image = bias.text("image");
  const std::string image = path_named_in(learned.file, "/bias/image", learned.image).string();
  UnitMap map;
  map.reference_at = bias.number("reference_at_px", {-200.0, 200.0});
  map.reference = channel_of(image, "reference_px");
  map.camera = channel_of(image, "camera_px");
  learned.map = std::make_shared<const UnitMap>(std::move(map));
  return learned;
}

}  // namespace fathom
