#include "trials/labelled_clouds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/progress.h"
#include "core/units.h"
#include "detector/read_cloud.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr double kSamePlaceMetres = 0.020;  // half of the smallest cup: circles by eye and by the paper differ by 6 mm

bool is_cup(const std::string& object) {
  return object == "mug_upright" || object == "cup_upright" || object == "tumbler_upright";
}

LabelledContainer container_of(const Table& table, std::size_t row) {
  const auto metres = [&](const char* column) -> std::optional<double> {
    if (!table.has(column)) return std::nullopt;
    const auto mm = table.number_if_any(row, column);
    return mm ? std::optional(metres_from_mm(*mm)) : std::nullopt;
  };
  LabelledContainer container{};
  container.scene = table.text(row, "scene");
  container.labels = table.text(row, "labels");
  container.object = table.text(row, "object");
  container.on_desk = table.text(row, "support") == "table";
  container.is_cup = is_cup(container.object);
  container.distance_m = table.number(row, "horiz_dist_m");
  constexpr double kFarthest = 10.0;
  if (container.distance_m < 0.0 || container.distance_m > kFarthest)
    table.fail(row, "horiz_dist_m",
               fmt::format("must be in metres, from 0 to {:g}, got '{}'", kFarthest, table.text(row, "horiz_dist_m")));
  container.radius_m = metres("circle_r_mm");
  container.floor_m = metres("inner_median_mm");
  return container;
}

std::vector<fs::path> clouds_in(const fs::path& folder) {
  std::vector<fs::path> clouds;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == ".pcd" || entry.path().extension() == ".ply") clouds.push_back(entry.path());
  if (clouds.empty()) throw Error(folder.string(), "holds no clouds (*.pcd, *.ply)");
  std::sort(clouds.begin(), clouds.end());
  return clouds;
}

/// The container of the scene that stands at this distance and has nothing yet.
LabelledContainer* container_at(std::vector<LabelledContainer>& containers, const std::string& scene,
                                const Circle& circle, bool (*is_free)(const LabelledContainer&)) {
  LabelledContainer* nearest = nullptr;
  const auto off = [&](const LabelledContainer& one) { return std::abs(one.distance_m - circle.center.norm()); };
  for (LabelledContainer& one : containers)
    if (one.scene == scene && is_free(one) && off(one) < kSamePlaceMetres && (!nearest || off(one) < off(*nearest)))
      nearest = &one;
  return nearest;
}

void match(const Detection& detection, const std::string& scene, LabelledResult& result) {
  for (const DetectedCup& cup : detection.cups) {
    const Circle& circle = *cup.candidate.circle;
    LabelledContainer* place =
        container_at(result.containers, scene, circle, [](const LabelledContainer& one) { return !one.found; });
    if (!place) {
      result.unlabelled.push_back(fmt::format("{} at {:.0f} mm, radius {:.1f} mm", scene,
                                              mm_from_metres(circle.center.norm()), mm_from_metres(circle.radius_m)));
      continue;
    }
    place->found = cup;
    if (cup.interior) place->seen_floor_m = cup.interior->mean_m;
  }
  for (const RejectedSegment& rejected : detection.rejected) {
    if (!rejected.candidate.circle) continue;
    LabelledContainer* place =
        container_at(result.containers, scene, *rejected.candidate.circle,
                     [](const LabelledContainer& one) { return !one.found && one.reason.empty(); });
    if (!place) continue;
    place->reason = rejected.candidate.rejected;
    if (rejected.interior) place->seen_floor_m = rejected.interior->mean_m;
  }
}

std::string mm_cell(const std::optional<double>& metres) {
  return metres ? fmt::format("{:.2f}", mm_from_metres(*metres)) : "";
}

}  // namespace

LabelledResult evaluate_folder(const fs::path& folder, const Method& method, const DetectorSettings& settings,
                               bool quiet) {
  const Table labels = read_table(folder / kLabelFile);
  LabelledResult result;
  for (std::size_t row = 0; row < labels.rows(); ++row) result.containers.push_back(container_of(labels, row));
  const std::vector<fs::path> clouds = clouds_in(folder);
  for (std::size_t row = 0; row < labels.rows(); ++row) {
    const std::string& scene = labels.text(row, "scene");
    if (std::none_of(clouds.begin(), clouds.end(), [&](const fs::path& cloud) { return cloud.stem() == scene; }))
      labels.fail(row, "scene", fmt::format("there is no cloud {}.pcd or {}.ply", scene, scene));
  }
  Progress progress("evaluate", clouds.size(), quiet);
  for (const fs::path& cloud : clouds) {
    match(method.detect(read_cloud(cloud), settings), cloud.stem().string(), result);
    ++result.scenes;
    progress.step();
  }
  return result;
}

Table containers_table(const LabelledResult& result) {
  Table table({"scene", "labels", "object", "on_desk", "distance_mm", "found", "radius_mm", "label_radius_mm",
               "floor_mm", "label_floor_mm", "liquid", "p_liquid", "why"});
  const auto yes_no = [](bool yes) { return std::string(yes ? "yes" : "no"); };
  for (const LabelledContainer& one : result.containers) {
    const DetectedCup* cup = one.found ? &*one.found : nullptr;
    std::string why = cup ? cup->why : one.reason;
    std::replace(why.begin(), why.end(), ',', ';');
    table.add({one.scene, one.labels, one.object, yes_no(one.on_desk), mm_cell(one.distance_m), yes_no(cup),
               cup ? mm_cell(cup->candidate.circle->radius_m) : "", mm_cell(one.radius_m), mm_cell(one.seen_floor_m),
               mm_cell(one.floor_m), cup ? std::string(name_of(cup->liquid)) : "",
               cup && cup->p_liquid ? fmt::format("{:.4f}", *cup->p_liquid) : "", why});
  }
  for (std::string place : result.unlabelled) {
    std::replace(place.begin(), place.end(), ',', ';');
    table.add({place.substr(0, place.find(' ')), "", "unlabelled", "", "", "yes", "", "", "", "", "", "", place});
  }
  return table;
}

}  // namespace fathom
