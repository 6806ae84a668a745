#include "diagnosis/unit/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "core/estimate.h"
#include "core/input_policy.h"
#include "core/progress.h"
#include "core/units.h"
#include "detector/pinhole.h"
#include "detector/read_cloud.h"
#include "diagnosis/unit/bias_learner.h"

namespace fathom {
namespace {

// At 640 × 480 [px]: of the infrared cameras as spec sheets have them, and of the colour camera as drivers take it.
constexpr std::array kFocals_px{570.342, 575.816};
constexpr double kColourFocal_px = 525.0, kColourCamera_m = 0.025;
constexpr int kWidth = 640, kHeight = 480;
constexpr double kMostWarmUp_px = 2.0;  ///< by which a device that warms up shifts all disparities

/// One cloud's desk.
struct Reading {
  CalibrationView desk;
  std::optional<double> time_s;
};

/// Of an organised cloud's rays, for an image 640 wide; 0: not organised.
double image_focal_px(const Cloud& cloud) {
  const std::optional<Pinhole> pinhole = pinhole_of(cloud);
  return pinhole ? pinhole->focal_x_px * kWidth / cloud.width : 0.0;
}

/// Throws Error on a cloud that must be in other units.
Cloud read_in_metres(const std::filesystem::path& file) {
  Cloud cloud = read_cloud(file);
  if (const std::string doubt = doubt_of_units(cloud); !doubt.empty()) throw Error(file.string(), doubt);
  return cloud;
}

/// The first clouds say what device this is.
void look_at_device(const std::vector<CalibrationCloud>& clouds, const CalibrationOptions& options,
                    UnitCalibration& result) {
  constexpr std::size_t kFew = 3;
  std::vector<Points> first;
  for (std::size_t i = 0; i < std::min(kFew, clouds.size()); ++i) {
    const Cloud cloud = read_in_metres(clouds[i].file);
    if (i == 0) result.image_focal_px = image_focal_px(cloud);
    first.push_back(cloud.points);
  }
  std::vector<double> focals(kFocals_px.begin(), kFocals_px.end());
  if (options.focal_px) focals = {*options.focal_px};
  result.depths = depth_facts(first, focals, options.baseline_m);
  const bool registered = options.registered.value_or(result.image_focal_px > 0.0 &&
                                                      std::abs(result.image_focal_px / kColourFocal_px - 1.0) < 0.01);
  result.scale.baseline_m = options.baseline_m;
  result.scale.camera_m = registered ? kColourCamera_m : 0.0;
  result.scale.cut_m = metres_from_mm(result.depths.cut_mm);
  if (options.focal_px)
    result.scale.focal_px = *options.focal_px;
  else if (result.depths.step_px > 0.0)
    result.scale.focal_px = result.depths.focal_px;
  else if (!registered && result.image_focal_px > 0.0)
    result.scale.focal_px = result.image_focal_px;
  else
    result.scale.focal_px = kFocals_px.front();
  if (result.image_focal_px <= 0.0) result.image_focal_px = registered ? kColourFocal_px : result.scale.focal_px;
}

Plane desk_of(const CalibrationCloud& cloud, const Points& points, const CalibrationOptions& options,
              const DeviceScale& scale) {
  constexpr std::size_t kEnough = 60'000;
  Points some;
  const std::size_t every = std::max<std::size_t>(1, points.size() / kEnough);
  for (std::size_t i = 0; i < points.size(); i += every)
    if (points[i].allFinite() && points[i].z() > 0.0f) some.push_back(points[i]);
  if (some.size() < 100) throw Error(cloud.file.string(), "no desk found: fewer than 100 points were measured");
  std::vector<float> depths;
  for (const Eigen::Vector3f& point : some) depths.push_back(point.z());
  std::nth_element(depths.begin(), depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2), depths.end());
  const double depth = depths[depths.size() / 2];
  PlaneSearch search;  // far away a step of disparity is centimetres
  search.threshold_m = std::max(search.threshold_m, 0.5 * depth * depth / (scale.focal_px * scale.baseline_m));
  const auto desk = choose_desk(find_planes(some, search), options.mounted, search);
  if (!desk)
    throw Error(cloud.file.string(), options.mounted ? "no desk found where --height-mm and --pitch-deg put it"
                                                     : "no desk found: no plane faces the sensor within 60°");
  return desk->plane;
}

struct Scenes {
  std::vector<BiasView> views;
  std::vector<std::size_t> of_reading;  ///< the number of each reading's view
};

/// Frames of one scene that stands still are one view: what its dots do is the same in all of them.
Scenes merged(const std::vector<Reading>& readings) {
  constexpr PoseTolerance kSamePose{.shift_px = kMostWarmUp_px, .turn_px = 0.1};  // means of 1000 pixels: 0.02 px
  constexpr double kSameCells = 0.95;                                             // a desk's edge is found anew
  std::vector<BiasView> views;
  for (const Reading& reading : readings) views.push_back(reading.desk.view);
  set_states_by_pose(views, kSamePose);
  using Place = std::pair<double, double>;
  struct Scene {
    int state;
    std::size_t clouds = 1;
    std::map<Place, BiasView> cells;  ///< as many readings as it was desk in
  };
  std::vector<Scene> scenes;
  Scenes result;
  for (const BiasView& view : views) {
    const auto is_same = [&](const Scene& scene) {
      std::size_t both = 0;
      for (const BiasCell& cell : view.cells) both += scene.cells.contains({cell.column_px, cell.row_px});
      return scene.state == view.state &&
             static_cast<double>(both) >
                 kSameCells * static_cast<double>(std::max(view.cells.size(), scene.cells.size()));
    };
    auto scene = std::ranges::find_if(scenes, is_same);
    result.of_reading.push_back(static_cast<std::size_t>(scene - scenes.begin()));
    if (scene == scenes.end())
      scene = scenes.insert(scenes.end(), {view.state, 1, {}});
    else
      ++scene->clouds;
    for (std::size_t i = 0; i < view.cells.size(); ++i) {
      BiasView& place = scene->cells[{view.cells[i].column_px, view.cells[i].row_px}];
      place.cells.push_back(view.cells[i]);
      place.errors_px.push_back(view.errors_px[i]);
    }
  }
  for (const Scene& scene : scenes) {
    BiasView& view = result.views.emplace_back();
    for (const auto& [at, readings_of_cell] : scene.cells) {
      BiasCell cell{at.first, at.second, 0.0, 0.0};
      double error = 0.0;
      for (std::size_t i = 0; i < readings_of_cell.cells.size(); ++i) {
        const BiasCell& read = readings_of_cell.cells[i];
        cell.nearer_px += read.nearer_px * read.pixels, cell.pixels += read.pixels;
        error += readings_of_cell.errors_px[i] * read.pixels;
      }
      cell.nearer_px /= cell.pixels;
      view.errors_px.push_back(error / cell.pixels);
      cell.pixels /= static_cast<double>(scene.clouds);
      view.cells.push_back(cell);
    }
  }
  set_states_by_pose(result.views);
  return result;
}

/// Errors of a view less the field, its plane apart: sum of squares over its cells.
double squares_left(const BiasView& view, const BiasField& field, int state) {
  std::vector<double> left;
  for (std::size_t i = 0; i < view.cells.size(); ++i)
    left.push_back(view.errors_px[i] - field.at({view.cells[i].pixel_px(), view.cells[i].nearer_px, state}));
  const Eigen::Vector3d plane = plane_through(view.cells, left);
  double sum = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i)
    sum += std::pow(left[i] - plane.dot(plane_at(view.cells[i].pixel_px())), 2.0);
  return sum;
}

/// Views are left out one by one; of many, several at a time.
void judge(const std::vector<BiasView>& views, const BiasField& of_all, UnitCalibration& result) {
  constexpr std::size_t kMostTimes = 12;
  const std::size_t times = std::min(kMostTimes, views.size());
  double before = 0.0, left = 0.0;
  for (std::size_t time = 0; time < times; ++time) {
    std::vector<BiasView> others;
    for (std::size_t i = 0; i < views.size(); ++i)
      if (i % times != time) others.push_back(views[i]);
    const BiasField field = others.empty() ? of_all : BiasLearner(others, result.prior).learn();
    for (std::size_t i = time; i < views.size(); i += times) {
      before += squares_left(views[i], BiasField(), kNoState);
      left += squares_left(views[i], field, views[i].state);
    }
  }
  result.without_px = std::sqrt(before / static_cast<double>(result.cells));
  result.left_px = std::sqrt(left / static_cast<double>(result.cells));
}

/// From a pixel of the clouds' image to what the device has there.
class Sight {
 public:
  Sight(const std::vector<const Reading*>& readings, const UnitCalibration& calibration)
      : scale_(calibration.scale), image_focal_px_(calibration.image_focal_px) {
    for (const Reading* reading : readings) {
      plane_ += -reading->desk.plane.normal / reading->desk.plane.offset / static_cast<double>(readings.size());
      for (const BiasCell& cell : reading->desk.view.cells)
        nearest_ = std::max(nearest_, cell.nearer_px), farthest_ = std::min(farthest_, cell.nearer_px);
    }
  }

  BiasPoint at(double column_px, double row_px, int state = kNoState) const {
    const double u = (column_px - 0.5 * kWidth) / image_focal_px_, v = (row_px - 0.5 * kHeight) / image_focal_px_;
    const double product = scale_.focal_px * scale_.baseline_m, at_reference = product / kReferenceDistance_m;
    const double nearer =
        std::clamp(product * plane_.dot(Eigen::Vector3d(u, v, 1.0)) - at_reference, farthest_, nearest_);
    const double inverse_depth = (nearer + at_reference) / product;
    return {
        {scale_.focal_px * (u + scale_.camera_m * inverse_depth) + 0.5 * kWidth, scale_.focal_px * v + 0.5 * kHeight},
        nearer,
        state};
  }

 private:
  DeviceScale scale_;
  double image_focal_px_;
  Eigen::Vector3d plane_ = Eigen::Vector3d::Zero();  ///< 1/z of the mean desk = that · (x/z, y/z, 1)
  double nearest_ = -1e9, farthest_ = 1e9;
};

Image<float> image_of(const Sight& sight, const BiasField& field, int state) {
  Image<float> image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) image(x, y) = static_cast<float>(field.at(sight.at(x + 0.5, y + 0.5, state)));
  return image;
}

/// Sigma changes slowly, and takes long: bilinear between the middles of cells.
Image<float> sigma_of(const Sight& sight, const BiasLearner& learner) {
  const int across = static_cast<int>(kWidth / kBiasCell_px) + 1, down = static_cast<int>(kHeight / kBiasCell_px) + 1;
  Image<float> coarse(across, down), image(kWidth, kHeight);
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x)
      coarse(x, y) = static_cast<float>(learner.sigma(sight.at(x * kBiasCell_px, y * kBiasCell_px)));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double column = (x + 0.5) / kBiasCell_px, row = (y + 0.5) / kBiasCell_px;
      const int left = std::min(static_cast<int>(column), across - 2), top = std::min(static_cast<int>(row), down - 2);
      const auto u = static_cast<float>(column - left), v = static_cast<float>(row - top);
      image(x, y) = (1 - v) * ((1 - u) * coarse(left, top) + u * coarse(left + 1, top)) +
                    v * ((1 - u) * coarse(left, top + 1) + u * coarse(left + 1, top + 1));
    }
  return image;
}

/// Where the squares of any view are desk.
Image<char> seen_in(const Sight& sight, const std::vector<BiasView>& views) {
  std::set<std::pair<int, int>> squares;
  const auto number = [](double at_px) { return static_cast<int>(std::floor(at_px / kBiasCell_px)); };
  for (const BiasView& view : views)
    for (const BiasCell& cell : view.cells) squares.emplace(number(cell.column_px), number(cell.row_px));
  Image<char> seen(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector2d pixel_px = sight.at(x + 0.5, y + 0.5).pixel_px;
      seen(x, y) = squares.contains({number(pixel_px.x()), number(pixel_px.y())});
    }
  return seen;
}

void map_bias(const std::vector<Reading>& readings, const Scenes& scenes, const BiasLearner& learner,
              const BiasField& field, UnitCalibration& result) {
  std::vector<const Reading*> all;
  double nearer = 0.0, cells = 0.0;
  for (const Reading& reading : readings) {
    all.push_back(&reading);
    for (const BiasCell& cell : reading.desk.view.cells) nearer += cell.nearer_px, cells += 1.0;
  }
  const Sight sight(all, result);
  result.bias_px = image_of(sight, field, kNoState);
  result.sigma_px = sigma_of(sight, learner);
  result.seen = seen_in(sight, scenes.views);
  result.reference_at_px = std::round(nearer / cells);
  result.reference_px = result.camera_px = Image<float>(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      result.reference_px(x, y) = static_cast<float>(field.reference_at(x + 0.5 - result.reference_at_px, y + 0.5));
      result.camera_px(x, y) = static_cast<float>(field.camera_at(x + 0.5, y + 0.5));
    }
  constexpr std::size_t kMostPoses = 32;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const int state = scenes.views[scenes.of_reading[i]].state;
    if (static_cast<std::size_t>(state) == result.poses.size() && result.poses.size() < kMostPoses) {
      const Plane& plane = readings[i].desk.plane;
      result.poses.push_back({0,
                              mm_from_metres(plane.offset),
                              deg_from_radians(pitch_above(plane)),
                              deg_from_radians(roll_above(plane)),
                              {}});
      result.poses.back().bias_px = image_of(Sight({&readings[i]}, result), field, state);
    }
    if (static_cast<std::size_t>(state) < result.poses.size()) ++result.poses[state].clouds;
  }
}

/// Views and poses have equations of their own, which are there twice while views are left out.
void require_room(const std::vector<BiasView>& views, std::size_t cells, const std::string& file) {
  constexpr std::uint64_t kTwice = 2, kOfState = 3, kOfCell = 110;  // squares of waves, numbers
  std::uint64_t poses = 0;
  for (const BiasView& view : views) poses = std::max<std::uint64_t>(poses, view.state + 1);
  const auto waves = static_cast<std::uint64_t>(Cosines(kMostWave_per_px).size());
  const std::uint64_t bytes = bytes_of({kTwice, sizeof(double), kOfState, poses, waves, waves}) +
                              bytes_of({kTwice, sizeof(double), kOfCell, cells});
  require_within_limit(file, "", bytes, fmt::format("equations of {} views in {} poses", views.size(), poses));
}

/// Most often because of another unit.
void require_possible_depth(const CalibrationView& desk, const DeviceScale& scale, const std::filesystem::path& file) {
  constexpr double kNearest_m = 0.2, kFarthest_m = 10.0;  // of such devices: 0.4 to 8 m
  const double product = scale.focal_px * scale.baseline_m;
  Mean disparity_px;
  for (const BiasCell& cell : desk.view.cells) disparity_px.add(cell.nearer_px + product / kReferenceDistance_m);
  const double depth_m = product / disparity_px.estimate().value;
  if (depth_m < kNearest_m || depth_m > kFarthest_m)
    throw Error(file.string(),
                fmt::format("its desk would be {:.3g} m away, must be from {:g} to {:g}: is this cloud in "
                            "metres, in the camera's frame?",
                            depth_m, kNearest_m, kFarthest_m));
}

std::optional<WarmUp> warm_up_in(const std::vector<Reading>& readings) {
  std::vector<TimedDisparity> timed;
  std::vector<BiasView> views;
  for (const Reading& reading : readings) views.push_back(reading.desk.view);
  set_states_by_pose(views, {kMostWarmUp_px, kMostWarmUp_px});
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!readings[i].time_s || views[i].state != views.front().state) continue;
    const Plane& plane = readings[i].desk.plane;
    timed.push_back({*readings[i].time_s, -plane.normal.z() / plane.offset});
  }
  return warm_up_of(timed);
}

}  // namespace

UnitCalibration calibrate(const std::vector<CalibrationCloud>& clouds, const CalibrationOptions& options, bool quiet) {
  UnitCalibration result;
  look_at_device(clouds, options, result);
  std::vector<Reading> readings;
  NoiseSums noise;
  Progress progress("calibrate", clouds.size(), quiet);
  for (const CalibrationCloud& cloud : clouds) {
    const Cloud read = read_in_metres(cloud.file);
    const Plane guess = desk_of(cloud, read.points, options, result.scale);
    auto desk = desk_view({&read.points, 1}, guess, result.scale);
    if (!desk) throw Error(cloud.file.string(), "no desk found: it covers fewer than 20 squares of 16 pixels");
    require_possible_depth(*desk, result.scale, cloud.file);
    noise.add(read.points, read.height > 1 ? read.width : 1, desk->plane, result.scale);
    readings.push_back({std::move(*desk), cloud.time_s});
    progress.step();
  }
  const Scenes scenes = merged(readings);
  const std::vector<BiasView>& views = scenes.views;
  result.clouds = clouds.size();
  result.views = views.size();
  for (const BiasView& view : views) result.cells += view.cells.size();
  require_room(views, result.cells, clouds.front().file.string());
  result.noise = noise.noise();
  result.warm_up = warm_up_in(readings);
  if (result.warm_up) {
    const double product = result.scale.focal_px * result.scale.baseline_m;
    result.warm_up->warm_up_px *= product, result.warm_up->sigma_px *= product;
  }
  result.prior = learned_bias_prior(views);
  const BiasLearner learner(views, result.prior);
  const BiasField field = learner.learn();
  judge(views, field, result);
  map_bias(readings, scenes, learner, field, result);
  return result;
}

}  // namespace fathom
