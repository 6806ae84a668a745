#include "blind/write_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "blind/device_frames.h"
#include "blind/laboratory.h"
#include "blind/observe.h"
#include "core/cloud_file.h"
#include "core/files.h"
#include "core/rng.h"
#include "core/table.h"
#include "core/units.h"

namespace fathom::blind {
namespace {

namespace fs = std::filesystem;

constexpr double kNear = 0.45, kFar = 1.0;           // about the cup
constexpr double kDeskNear = 0.45, kDeskFar = 1.25;  // in the whole image

enum class Key : std::uint64_t { standing = 301, desk, frame, mistake };

void apply_wrong_cup(World& world) {
  world.cup.height = 0.092;
  world.cup.inner_radius = 0.0365;
  world.cup.outer_radius = 0.0400;
  world.cup.bottom += -0.0025;
}

World world_of(const SetTruth& truth, const Placement& placement) {
  World world = true_world(placement, truth.seed, truth.noise_scale);
  std::vector<Active> effects;
  for (const Truth& hidden : truth.effects) effects.push_back(hidden.active);
  apply_all(world, placement, effects);
  world.heavy_tails = truth.heavy_tails;
  if (truth.book_keeping == "wrong_cup") apply_wrong_cup(world);
  return world;
}

/// The desk far from the cup is the same for all placements of a session.
class Desks {
 public:
  Desks(const SetTruth& truth, bool exact) : truth_(truth), exact_(exact) {}

  const Scene& in_session_of(const Placement& placement) {
    auto& scene = scenes_[placement.session];
    if (scene.matched.blocks.empty()) {
      Placement bare = placement;
      bare.liquid = "none";
      const World world = exact_ ? believed(bare) : world_of(truth_, bare);
      scene = stand(world, dots_for(world.sensor, whole_image(), kDeskNear, kDeskFar), false, whole_image(),
                    Rng(truth_.seed, Key::desk, placement.session).bits());
    }
    return scene;
  }

 private:
  const SetTruth& truth_;
  bool exact_;
  std::map<int, Scene> scenes_;
};

/// What is next to the cup, as seen from the sensor, is shadow and wall: the far desk's windows leave it alone.
Raster shadow_of(const Raster& near) {
  return {near.low - Eigen::Vector2i(60, 45), near.high + Eigen::Vector2i(12, 0), near.stride};
}

std::vector<CloudPoint> shoot(const World& world, const Scene* cup, const Raster& shadow, const Scene& desk,
                              std::uint64_t frame) {
  std::vector<CloudPoint> cloud;
  const Shake shake = shake_of(world, frame);
  if (cup) append_points(*cup, world, shake, frame, nullptr, cloud);
  append_points(desk, world, shake, mix_bits(frame), cup ? &shadow : nullptr, cloud);
  return cloud;
}

void write_cloud(const fs::path& path, const std::vector<CloudPoint>& points) {
  Image<CloudPoint> cloud(static_cast<int>(points.size()), 1);
  std::copy(points.begin(), points.end(), cloud.pixels().begin());
  put_pcd(path, cloud);  // the folder appears whole: no file needs to by itself
}

/// What a laboratory may write down wrongly: the table's rows.
struct Mistakes {
  const SetTruth& truth;

  bool in_first_session(const Placement& p) const { return p.session == 0; }

  std::string liquid(const Placement& p) const {
    // In one session the labels of two cups of one depth were taken for each other.
    if (truth.book_keeping == "label_swap" && in_first_session(p) && p.fill > 0.0)
      return p.liquid == "water" ? "milk_tea" : "water";
    return p.liquid;
  }
  double fill_mm(const Placement& p) const {
    const double mm = mm_from_metres(p.fill);
    return truth.book_keeping == "unit_error" ? 0.1 * mm : mm;  // in cm
  }
  double lateral_mm(const Placement& p) const {
    const double mm = mm_from_metres(p.lateral);
    return truth.book_keeping == "flipped_axis" ? 0.0 - mm : mm;
  }
  bool is_copy(const Placement& p, int trial) const {
    return truth.book_keeping == "duplicated_trial" && trial > 0 &&
           Rng(truth.seed, Key::mistake, p.number).uniform() < 0.4;
  }
};

std::string mm_text(double mm) { return fmt::format("{:g}", std::round(1e4 * mm) / 1e4 + 0.0); }

class FramesTable {
 public:
  explicit FramesTable(bool heights)
      : heights_(heights),
        table_(heights ? std::vector<std::string>{"frame", "session", "pour", "placement", "trial", "time_s", "liquid",
                                                  "fill_mm", "distance_mm", "lateral_mm", "cloud", "height_mm",
                                                  "height_sd_mm", "points"}
                       : std::vector<std::string>{"frame", "session", "pour", "placement", "trial", "time_s", "liquid",
                                                  "fill_mm", "distance_mm", "lateral_mm", "cloud"}) {}

  int rows() const { return static_cast<int>(table_.rows()); }

  void add(const Placement& p, int trial, const Mistakes& mistakes, const std::string& cloud,
           const std::optional<MeanHeight>& height) {
    std::vector<std::string> cells{fmt::format("{}", rows()),
                                   fmt::format("{}", p.session),
                                   fmt::format("{}", p.has_cup() ? p.pour : 0),
                                   fmt::format("{}", p.has_cup() ? p.number : 0),
                                   fmt::format("{}", trial),
                                   fmt::format("{:g}", p.time_s + trial * kSecondsPerTrial),
                                   mistakes.liquid(p),
                                   mm_text(mistakes.fill_mm(p)),
                                   mm_text(mm_from_metres(p.distance)),
                                   mm_text(mistakes.lateral_mm(p)),
                                   cloud};
    if (heights_) {
      if (!height) return;  // nothing seen in the cup: no line
      cells.push_back(fmt::format("{:.4f}", mm_from_metres(height->mean)));
      cells.push_back(fmt::format("{:.4f}", mm_from_metres(height->sd)));
      cells.push_back(fmt::format("{}", height->points));
    }
    table_.add(std::move(cells));
  }

  void write(const fs::path& path) const { write_table(path, table_); }

 private:
  bool heights_;
  Table table_;
};

/// What goes into one folder.
struct Measured {
  std::vector<Placement> placements;
  Json rig;
};

int write_folder(const SetTruth& truth, bool exact, const Measured& measured, const fs::path& folder) {
  const Design& chosen = design(truth.design);
  const Mistakes mistakes{truth};
  const bool heights = !chosen.clouds || exact;
  if (chosen.clouds) make_directory(folder / "clouds");
  write_json(folder / "rig.json", measured.rig);
  FramesTable table(heights);
  Desks desks(truth, exact);
  for (const Placement& p : measured.placements) {
    const Raster near = near_cup(p);
    World world = exact ? believed(p) : world_of(truth, p);
    std::optional<Scene> cup;
    if (exact) world.noise_scale = 0.0;
    if (p.has_cup())
      cup = stand(world, dots_for(world.sensor, near, kNear, kFar), true, near,
                  Rng(truth.seed, Key::standing, p.number).bits());
    std::vector<CloudPoint> cloud;
    for (int trial = 0; trial < (exact ? 1 : p.trials); ++trial) {
      world.seconds = p.time_s + trial * kSecondsPerTrial;
      if (trial == 0 || !mistakes.is_copy(p, trial))
        cloud = shoot(world, cup ? &*cup : nullptr, shadow_of(near), desks.in_session_of(p),
                      Rng(truth.seed, Key::frame, p.number, trial).bits());
      if (!chosen.infrared)
        for (CloudPoint& point : cloud) point.intensity = 0.0f;
      const std::string name = chosen.clouds ? fmt::format("clouds/{:05}.pcd", table.rows()) : "";
      table.add(p, trial, mistakes, name, heights && p.has_cup() ? mean_height(cloud, p) : std::nullopt);
      if (chosen.clouds) write_cloud(folder / name, cloud);
    }
  }
  table.write(folder / "frames.csv");
  return table.rows();
}

/// The folder is filled under another name: a killed run leaves nothing that looks whole.
int write_whole(const SetTruth& truth, bool exact, const Measured& measured, const fs::path& folder) {
  const fs::path beside = folder.string() + ".part";
  fs::remove_all(beside);
  make_directory(beside);
  const int frames = write_folder(truth, exact, measured, beside);
  fs::rename(beside, folder);
  return frames;
}

Measured first_measured(const SetTruth& truth) { return {plan(design(truth.design), truth.seed), rig_json()}; }

}  // namespace

int write_set(const SetTruth& truth, const fs::path& folder) {
  return write_whole(truth, false, first_measured(truth), folder);
}

int write_follow_up(const SetTruth& truth, const FollowUp& wanted, const fs::path& folder) {
  Measured measured{plan(wanted, plan(design(truth.design), truth.seed)), rig_json()};
  measured.rig["liquids"].update(wanted.new_liquids);
  return write_whole(truth, false, measured, folder);
}

int write_exact_set(const fs::path& folder) {
  const SetTruth nothing{.kind = "null", .design = "full"};
  return write_whole(nothing, true, first_measured(nothing), folder);
}

}  // namespace fathom::blind
