#include "sim/scene/clutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "core/json.h"
#include "core/rng.h"
#include "core/units.h"

namespace fathom {
namespace {

constexpr std::uint64_t kClutterStream = 0x636c7574746572ULL;
/// Objects that touch a cup or stand before it are this far from it [m].
constexpr double kTouchingMost = 0.002, kOccludingLeast = 0.020, kOccludingMost = 0.080;
/// Things before a cup stand within this angle of the line from it to the sensor's foot point.
constexpr double kOccludingAside = 15.0 * std::numbers::pi / 180.0;

struct Place {
  Eigen::Vector2d position;  ///< [m]
  double yaw;                ///< [rad]
};

/// A desk that is being laid. Every `put_…` returns nothing where the thing would stand in another's way.
class Desktop {
 public:
  Desktop(const ClutterSpec& spec, Rng rng) : spec_(spec), rng_(rng) {}

  double from(double low, double high) { return low + (high - low) * rng_.uniform(); }
  double any_angle() { return from(-std::numbers::pi, std::numbers::pi); }
  int from(const ClutterSpec::Count& count) {
    return count.low + static_cast<int>(rng_.below(static_cast<std::uint32_t>(count.high - count.low + 1)));
  }
  template <class T>
  const T& one_of(const std::vector<T>& choices) {
    return choices[rng_.below(static_cast<std::uint32_t>(choices.size()))];
  }

  SharedJson filling() { return rng_.uniform() < spec_.empty ? SharedJson::object() : one_of(spec_.fillings); }

  std::optional<Place> put_cup(const ClutterThing& cup) {
    const auto place = put_anywhere(cup);
    if (place) cups_.push_back(taken_.size() - 1);
    return place;
  }

  std::optional<Place> put_object(const ClutterThing& object) {
    const double how = rng_.uniform();
    if (cups_.empty() || how >= spec_.touching + spec_.occluding) return put_anywhere(object);
    const std::size_t cup = one_of(cups_);
    if (how < spec_.touching) return put_near(object, cup, any_angle(), from(0.0, kTouchingMost));
    const Eigen::Vector2d to_sensor = -origins_[cup];
    return put_near(object, cup, std::atan2(to_sensor.y(), to_sensor.x()) + from(-kOccludingAside, kOccludingAside),
                    from(kOccludingLeast, kOccludingMost));
  }

 private:
  std::optional<Place> put_anywhere(const ClutterThing& thing) {
    const Eigen::Vector2d &low = spec_.region.min(), &high = spec_.region.max();
    const Eigen::Vector2d position{from(low.x(), high.x()), from(low.y(), high.y())};
    return put(thing, {position, any_angle()}, std::nullopt);
  }

  /// At an azimuth from a cup, so that `distance` [m] is left between the two.
  std::optional<Place> put_near(const ClutterThing& thing, std::size_t cup, double azimuth, double distance) {
    const double yaw = any_angle();
    double low = 0.0, high = 1.0;  // [m] from origin to origin
    while (high - low > 1e-5) {
      const double middle = 0.5 * (low + high);
      const Eigen::Vector2d position = origins_[cup] + middle * direction_of(azimuth);
      (thing.footprint.placed(position, yaw).is_within(distance, taken_[cup]) ? low : high) = middle;
    }
    return put(thing, {origins_[cup] + high * direction_of(azimuth), yaw}, cup);
  }

  std::optional<Place> put(const ClutterThing& thing, const Place& place, std::optional<std::size_t> neighbour) {
    Footprint footprint = thing.footprint.placed(place.position, place.yaw);
    for (std::size_t i = 0; i < taken_.size(); ++i)
      if (i != neighbour && footprint.is_within(spec_.gap, taken_[i])) return std::nullopt;
    taken_.push_back(std::move(footprint));
    origins_.push_back(place.position);
    return place;
  }

  const ClutterSpec& spec_;
  Rng rng_;
  std::vector<Footprint> taken_;
  std::vector<Eigen::Vector2d> origins_;
  std::vector<std::size_t> cups_;  ///< which of them
};

/// Numbers in scene files end at 0.1 µm and 1 µrad: short, and the same on every machine.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

void set_position(const Place& place, Json& entry) {
  entry["position_mm"] = {rounded(mm_from_metres(place.position.x())), rounded(mm_from_metres(place.position.y()))};
}

Json placed_cup(const ClutterThing& cup, const Json& filling, const Place& place) {
  Json entry = cup.entry;
  set_position(place, entry);
  entry["yaw_deg"] = rounded(deg_from_radians(place.yaw));
  entry.update(filling);
  return entry;
}

/// The turn about the upright axis comes last, as in `rotation_deg`.
Json placed_object(const ClutterThing& object, const Place& place) {
  Json entry = object.entry;
  set_position(place, entry);
  Json rotation = entry.value("rotation_deg", Json{0.0, 0.0, 0.0});
  rotation[2] = rounded(rotation[2].get<double>() + deg_from_radians(place.yaw));
  entry["rotation_deg"] = rotation;
  return entry;
}

/// Nothing where a thing found no place.
std::optional<Json> try_scene(const ClutterSpec& spec, Rng rng) {
  constexpr int kTries = 30;  // for each thing, before the desk is cleared
  Desktop desktop(spec, rng);
  Json scene{{"sensor", spec.sensor}, {"desk", spec.desk}, {"cups", Json::array()}, {"objects", Json::array()}};
  const auto lay = [&](int number, auto put_one) {
    for (int i = 0; i < number; ++i) {
      int tries = kTries;
      while (tries > 0 && !put_one()) --tries;
      if (tries == 0) return false;
    }
    return true;
  };
  const bool laid = lay(desktop.from(spec.cups),
                        [&] {
                          const ClutterThing& cup = desktop.one_of(spec.cup_kinds);
                          const auto place = desktop.put_cup(cup);
                          if (place) scene["cups"].push_back(placed_cup(cup, desktop.filling(), *place));
                          return place.has_value();
                        }) &&
                    lay(desktop.from(spec.objects), [&] {
                      const ClutterThing& object = desktop.one_of(spec.object_kinds);
                      const auto place = desktop.put_object(object);
                      if (place) scene["objects"].push_back(placed_object(object, *place));
                      return place.has_value();
                    });
  return laid ? std::optional(std::move(scene)) : std::nullopt;
}

}  // namespace

Json random_scene(const ClutterSpec& spec, std::uint64_t seed, std::uint64_t number) {
  constexpr std::uint64_t kTries = 100;
  for (std::uint64_t attempt = 0; attempt < kTries; ++attempt)
    if (auto scene = try_scene(spec, Rng(seed, kClutterStream, number, attempt))) return *std::move(scene);
  throw Error("clutter", fmt::format("scene {}", number),
              fmt::format("has no room for up to {} cups and {} objects, make region_mm larger or gap_mm smaller",
                          spec.cups.high, spec.objects.high));
}

}  // namespace fathom
