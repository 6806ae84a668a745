// A detection's folder as the page's data.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.h"
#include "core/range.h"
#include "core/units.h"
#include "detector/cone.h"
#include "detector/plane.h"
#include "detector/read_cloud.h"
#include "report/kept_detection.h"
#include "view/packed.h"
#include "view/scenes.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// What of the detection's JSON the page shows. Everything else of a file that others may have written stays outside.
struct Shown {
  const char* key;
  Range range;
};
constexpr Shown kOfDesk[] = {{"height_mm", kPlaceMm}, {"pitch_deg", {-90.0, 90.0}}, {"rms_mm", kLengthOrNoneMm}};
constexpr Shown kOfCup[] = {
    {"radius_mm", kLengthMm},     {"height_mm", kLengthMm},        {"radius_sigma_mm", kNonNegative},
    {"lean_deg", {-89.0, 89.0}},  {"p_liquid", {0.0, 1.0}},        {"surface_mm", kPlaceMm},
    {"sigma_mm", kNonNegative},   {"sd_mm", kNonNegative},         {"bottom_mm", kPlaceMm},
    {"fill_mm", kLengthOrNoneMm}, {"fill_sigma_mm", kNonNegative}, {"rms_mm", kNonNegative}};
constexpr Shown kOfCandidate[] = {{"width_mm", kLengthOrNoneMm}, {"height_mm", kPlaceMm}, {"surface_mm", kPlaceMm}};

/// Numbers, or null where nothing was seen.
template <std::size_t N>
Json shown(const JsonReader& json, const Shown (&keys)[N]) {
  Json result = Json::object();
  for (const Shown& one : keys) {
    const JsonReader value = json.at(one.key);
    result[one.key] = value.value().is_null() ? Json() : Json(value.number(one.range));
  }
  return result;
}

double metres_of(const Json& shown, const char* key) { return metres_from_mm(shown[key].get<double>()); }

/// Where a point belongs to something that stands on the desk.
struct Standing {
  Eigen::Vector2d middle;
  double radius, lean, height;  ///< [m] radius 45 mm above the desk

  bool holds(const Eigen::Vector3d& point, double tolerance) const {
    constexpr double kOnDesk = 0.008;  // [m] up to which a point beside a wall may be the desk's
    const double wall = radius + lean * (point.z() - kWallHeight) + (point.z() > kOnDesk ? tolerance : 0.0);
    return (point.head<2>() - middle).norm() < wall && point.z() < height + tolerance;
  }
};

/// Cloud number `number` of what detect wrote: one cloud as an object, several as a list.
JsonReader of_cloud(const JsonReader& all, const fs::path& folder, int number) {
  const bool is_list = all.value().is_array();
  const std::vector<JsonReader> items = is_list ? all.items() : std::vector<JsonReader>{all};
  if (items.empty()) all.fail("holds no detection");
  if (number >= static_cast<int>(items.size()))
    throw Error(folder.string(),
                fmt::format("is of {} clouds, so --frame must be at most {}", items.size(), items.size() - 1));
  return items[number];
}

Points cloud_of(const fs::path& folder, int number) {
  const fs::path file = kept_cloud(folder, number);
  if (!fs::exists(file))
    throw Error(file.string(),
                fmt::format("is missing: the view needs the cloud that was searched. fathom detect -o keeps it where "
                            "--keep-clouds is at least {}",
                            number + 1));
  return finite_points(read_cloud(file));
}

/// To a frame with z up where there is no desk: as if the sensor looked level.
Eigen::Isometry3d level_from_camera() {
  Eigen::Matrix3d axes;
  axes << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
  return Eigen::Isometry3d(axes);
}

Plane plane_from(const JsonReader& json) {
  const Eigen::Vector3d normal = json.at("normal").vector3();
  if (std::abs(normal.norm() - 1.0) > 1e-3) json.fail_at("normal", "must have the length 1");
  return {normal.normalized(), metres_from_mm(json.number("height_mm", kPlaceMm))};
}

/// Everything that was found, with its place on the desk and what the page says of it.
class Found {
 public:
  Found(const JsonReader& json, const Eigen::Isometry3d& to_desk) : to_desk_(to_desk) {
    for (const JsonReader& cup : json.at("cups").items()) add_cup(cup);
    for (const JsonReader& candidate : json.at("candidates").items()) add_candidate(candidate);
    constexpr std::size_t kMost = 1000;
    if (standing_.size() > kMost)
      json.fail(fmt::format("has {} cups and candidates, at most {} are shown", standing_.size(), kMost));
  }

  /// 0: nothing; 1: the desk; from 2: cups, then candidates.
  std::uint16_t owner_of(const Eigen::Vector3d& point) const {
    constexpr double kTolerance = 0.004, kDesk = 0.01;  // [m]
    for (std::size_t i = 0; i < standing_.size(); ++i)
      if (standing_[i].holds(point, kTolerance)) return static_cast<std::uint16_t>(2 + i);
    return std::abs(point.z()) < kDesk ? 1 : 0;
  }

  Json cups = Json::array(), candidates = Json::array();

 private:
  Json place(const JsonReader& json) const {
    constexpr Range kPlace_m{-1e3, 1e3};
    const Eigen::Vector3d at = to_desk_ * json.at("center_camera_m").vector3(kPlace_m);
    return {at.x(), at.y()};
  }
  static Eigen::Vector2d middle_of(const Json& at) { return {at[0].get<double>(), at[1].get<double>()}; }

  void add_cup(const JsonReader& json) {
    static const std::string kLiquid[] = {"yes", "no", "unknown"}, kKind[] = {"transparent", "opaque", "unknown"};
    Json cup = shown(json, kOfCup);
    for (const char* needed : {"radius_mm", "height_mm"})
      if (cup[needed].is_null()) json.fail_at(needed, "must be a number");
    cup["at_m"] = place(json);
    cup["liquid"] = kLiquid[json.at("liquid").choice(kLiquid, "answer")];
    cup["kind"] = kKind[json.at("kind").choice(kKind, "kind")];
    cup["why"] = json.text("why");
    const double lean = cup["lean_deg"].is_null() ? 0.0 : std::tan(radians_from_deg(cup["lean_deg"].get<double>()));
    standing_.push_back({middle_of(cup["at_m"]), metres_of(cup, "radius_mm"), lean, metres_of(cup, "height_mm")});
    cups.push_back(std::move(cup));
  }

  void add_candidate(const JsonReader& json) {
    Json candidate = shown(json, kOfCandidate);
    for (const char* needed : {"width_mm", "height_mm"})
      if (candidate[needed].is_null()) json.fail_at(needed, "must be a number");
    candidate["at_m"] = place(json);
    candidate["reason"] = json.text("reason");
    standing_.push_back(
        {middle_of(candidate["at_m"]), 0.5 * metres_of(candidate, "width_mm"), 0.0, metres_of(candidate, "height_mm")});
    candidates.push_back(std::move(candidate));
  }

  Eigen::Isometry3d to_desk_;
  std::vector<Standing> standing_;
};

std::string name_of_cloud(const JsonReader& json) {
  if (!json.has("clouds")) return json.text_or("cloud", "");
  return fmt::format("{} views as one", json.at("clouds").items().size());
}

}  // namespace

Json detection_scene(const fs::path& folder, int number) {
  const fs::path file = folder / kDetectionFile;
  const Json all = read_json(file);
  const JsonReader json = of_cloud(JsonReader(all, file.string()), folder, number);
  const JsonReader plane = json.at("plane");
  const bool has_desk = !plane.value().is_null();
  const Eigen::Isometry3d to_desk = has_desk ? desk_from_camera(plane_from(plane)) : level_from_camera();
  const Found found(json, to_desk);
  const Points cloud = cloud_of(folder, number);

  constexpr std::size_t kMostPoints = 640 * 480;
  const std::size_t every = std::max<std::size_t>((cloud.size() + kMostPoints - 1) / kMostPoints, 1);
  std::vector<Eigen::Vector3d> points;
  double farthest = 1.0;
  for (std::size_t i = 0; i < cloud.size(); i += every) {
    points.push_back(to_desk * cloud[i].cast<double>());
    farthest = std::max(farthest, points.back().cwiseAbs().maxCoeff());
  }
  const PlaceCode code(farthest);
  std::vector<std::int16_t> places;
  std::vector<std::uint16_t> owners;
  for (const Eigen::Vector3d& point : points) {
    code.add(point, places);
    owners.push_back(has_desk ? found.owner_of(point) : 0);
  }
  const Eigen::Matrix3d axes = to_desk.linear();
  return {{"cloud", name_of_cloud(json)},
          {"step_m", code.step()},
          {"every", every},
          {"camera", json_of(to_desk.translation())},
          {"forward", json_of(axes.col(2))},
          {"desk", has_desk ? shown(plane, kOfDesk) : Json()},
          {"why", json.text_or("why", "")},
          {"points", packed(places)},
          {"owners", packed(owners)},
          {"cups", found.cups},
          {"candidates", found.candidates}};
}

}  // namespace fathom
