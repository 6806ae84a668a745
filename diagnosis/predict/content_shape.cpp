#include "diagnosis/predict/content_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "core/estimate.h"
#include "core/units.h"
#include "diagnosis/measurement/named_values.h"

namespace fathom {
namespace {

constexpr std::size_t kFewestPlacements = 3;
constexpr std::size_t kFewestCells = 2;  // of a placement: a shape is their difference

/// By how much a cell is higher than the mean of some.
double above_mean(const CellHeights& heights, const CupCells& cells, int cell) {
  double sum = 0.0;
  for (int i = 0; i < kCupCells; ++i)
    if (cells[i]) sum += heights[i];
  return heights[cell] - sum / static_cast<double>(cells.count());
}

/// "12 mm right of and 24 mm before the middle", as the sensor sees it; "middle".
std::string words_at(const Eigen::Vector2d& at_mm) {
  std::vector<std::string> steps;
  if (std::abs(at_mm.x()) >= 0.5)
    steps.push_back(fmt::format("{:.0f} mm {} of", std::abs(at_mm.x()), at_mm.x() > 0.0 ? "right" : "left"));
  if (std::abs(at_mm.y()) >= 0.5)
    steps.push_back(fmt::format("{:.0f} mm {}", std::abs(at_mm.y()), at_mm.y() > 0.0 ? "beyond" : "before"));
  return steps.empty() ? "middle" : fmt::format("{} the middle", fmt::join(steps, " and "));
}

/// What the model no longer sees changes as the rest does.
CellHeights completed(const CellHeights& heights, const ContentSight& sight) {
  double change = 0.0, count = 0.0;
  for (int i = 0; i < kCupCells; ++i)
    if (sight.cells[i] && std::isfinite(heights[i])) change += heights[i] - sight.predicted[i], ++count;
  CellHeights all = heights;
  for (int i = 0; i < kCupCells; ++i)
    if (sight.cells[i] && !std::isfinite(heights[i])) all[i] = sight.predicted[i] + change / std::max(count, 1.0);
  return all;
}

Eigen::Vector2d middle_mm(int cell, double radius_m) { return mm_from_metres(radius_m) * middle_of_cell(cell); }

/// The cell, less the mean of those that each placement shows.
std::vector<SeenPart> parts_of_shape(const std::vector<std::shared_ptr<const ContentSight>>& sights, int cell,
                                     double radius_m) {
  std::array<double, kCupCells> weights{};
  for (const auto& sight : sights)
    for (int i = 0; i < kCupCells; ++i)
      if (sight->cells[i])
        weights[i] -= 1.0 / static_cast<double>(sight->cells.count()) / static_cast<double>(sights.size());
  weights[cell] += 1.0;
  std::vector<SeenPart> parts;
  for (int i = 0; i < kCupCells; ++i)
    if (weights[i] != 0.0) parts.push_back({middle_mm(i, radius_m), weights[i]});
  return parts;
}

ContentShape shape_of(std::vector<std::shared_ptr<const ContentSight>> sights, int cell, double radius_m) {
  Mean measured, errors, shares;
  for (const auto& sight : sights) {
    const double own = above_mean(sight->measured, sight->cells, cell);
    measured.add(own);
    shares.add(1.0 / static_cast<double>(sight->cells.count()));
    errors.add(own - above_mean(sight->predicted, sight->cells, cell));
  }
  ContentShape shape;
  Observation& observation = shape.observation;
  observation.observable = "content_shape_mm";
  observation.factors = sights[sights.size() / 2]->factors;
  const Eigen::Vector2d at = middle_mm(cell, radius_m);
  observation.parts = parts_of_shape(sights, cell, radius_m);
  observation.factors.region = words_at(at);
  observation.factors.within_mm = at;
  observation.value = measured.estimate().value;
  observation.repeats = static_cast<int>(sights.size());
  // Differences from the mean of n cells add up to 0, so they scatter less than cells do: their variance has n − 1 of n
  // parts. They are treated as independent, and have the error of a cell.
  observation.repeat_sd = errors.estimate().standard_error *
                          std::sqrt(static_cast<double>(sights.size()) / (1.0 - shares.estimate().value));
  observation.has_all_errors = true;
  shape.cell = cell;
  shape.sights = std::move(sights);
  return shape;
}

}  // namespace

CellHeights cell_heights(const FrameEstimates& estimates) {
  CellHeights heights{};
  for (int i = 0; i < kCupCells; ++i) {
    const RegionEstimate& cell = estimates.cell_height[i];
    heights[i] = is_surface(cell) ? mm_from_metres(cell.mean) : std::numeric_limits<double>::quiet_NaN();
  }
  return heights;
}

std::vector<SeenPart> parts_of_region(std::string_view region, const CupCells& seen, double radius_m) {
  const auto number = static_cast<std::size_t>(std::find(kCupRegionNames.begin(), kCupRegionNames.end(), region) -
                                               kCupRegionNames.begin());
  std::vector<SeenPart> all, clear;
  if (number == kCupRegionNames.size()) return all;
  for (int cell = 0; cell < kCupCells; ++cell) {
    const double share = shares_of_regions(middle_of_cell(cell), 1.0, 0.0)[number];
    if (share == 0.0) continue;
    all.push_back({middle_mm(cell, radius_m), share});
    if (seen[cell]) clear.push_back(all.back());
  }
  std::vector<SeenPart> parts = clear.empty() ? std::move(all) : std::move(clear);
  double sum = 0.0;
  for (const SeenPart& part : parts) sum += part.weight;
  for (SeenPart& part : parts) part.weight /= sum;
  return parts;
}

double ContentShape::predicted(const std::function<const CellHeights*(std::size_t condition)>& heights) const {
  double sum = 0.0;
  for (const auto& sight : sights)
    if (const CellHeights* own = heights(sight->condition))
      sum += above_mean(completed(*own, *sight), sight->cells, cell);
  return sum / static_cast<double>(sights.size());
}

std::vector<ContentShape> content_shapes(std::vector<ContentSight> sights, double radius_m) {
  std::map<std::pair<std::string, int>, std::vector<std::shared_ptr<const ContentSight>>> by_cell;
  for (ContentSight& sight : sights) {
    if (sight.cells.count() < kFewestCells) continue;
    const auto shared = std::make_shared<const ContentSight>(std::move(sight));
    for (int cell = 0; cell < kCupCells; ++cell)
      if (shared->cells[cell]) by_cell[{shared->factors.liquid, cell}].push_back(shared);
  }
  std::vector<ContentShape> shapes;
  for (auto& [key, seen] : by_cell)
    if (seen.size() >= kFewestPlacements) shapes.push_back(shape_of(std::move(seen), key.second, radius_m));
  return shapes;
}

}  // namespace fathom
