#include "diagnosis/measurement/copies.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <tuple>

#include "core/rng.h"

namespace fathom {
namespace {

constexpr std::size_t kFewestRows =
    3;  // of a table: its numbers are rounded, so that one or two may be alike by chance

/// A row and the earlier one that it repeats.
struct Pair {
  std::size_t row, earlier;
};

/// The earlier row is of the same placement, where one of it has the same cloud.
std::vector<Pair> equal_clouds(const std::vector<FrameRecord>& frames, std::span<const CloudPrint> prints) {
  std::map<std::uint64_t, std::map<PlacementKey, std::size_t>> firsts;
  std::map<std::uint64_t, std::size_t> first;
  std::vector<Pair> pairs;
  for (std::size_t row = 0; row < prints.size(); ++row) {
    const std::uint64_t print = prints[row].whole;
    if (print == 0) continue;
    const auto [of_all, is_new] = first.emplace(print, row);
    const auto [of_placement, is_first] = firsts[print].emplace(placement_of(frames[row]), row);
    if (!is_new) pairs.push_back({row, is_first ? of_all->second : of_placement->second});
  }
  return pairs;
}

using PlacementRows = std::map<PlacementKey, std::vector<std::size_t>>;

bool has_numbers(const FrameRecord& f) { return f.cloud.empty() && f.height_mm && f.height_sd_mm && f.points; }

/// The rows of a placement that stand in the table alone, without clouds.
std::vector<std::size_t> with_numbers(const std::vector<FrameRecord>& frames, const std::vector<std::size_t>& rows) {
  std::vector<std::size_t> with;
  for (const std::size_t row : rows)
    if (has_numbers(frames[row])) with.push_back(row);
  return with;
}

std::vector<Pair> equal_numbers(const std::vector<FrameRecord>& frames, const std::vector<std::size_t>& rows) {
  std::map<std::tuple<double, double, double>, std::size_t> first;
  std::vector<Pair> pairs;
  for (const std::size_t row : rows) {
    const FrameRecord& frame = frames[row];
    const auto [known, is_new] = first.emplace(std::tuple(*frame.height_mm, *frame.height_sd_mm, *frame.points), row);
    if (!is_new) pairs.push_back({row, known->second});
  }
  return pairs;
}

/// Rows that have the spread and one more number of an earlier one of their placement, but not the third.
std::size_t coincidences(const std::vector<FrameRecord>& frames, const std::vector<std::size_t>& rows) {
  std::set<std::pair<double, double>> with_height, with_points;  // spreads
  std::set<std::tuple<double, double, double>> known;
  std::size_t count = 0;
  for (const std::size_t row : rows) {
    const double height = *frames[row].height_mm, spread = *frames[row].height_sd_mm, points = *frames[row].points;
    const bool has_height = !with_height.emplace(spread, height).second;
    const bool has_points = !with_points.emplace(spread, points).second;
    const bool is_new = known.emplace(height, spread, points).second;
    count += is_new && (has_height || has_points);
  }
  return count;
}

/// Few points on the steps of depth have few different heights and spreads, so that rows are alike by chance: then
/// rows are nearly alike as well.
std::vector<Pair> equal_rows(const std::vector<FrameRecord>& frames, const PlacementRows& placements) {
  constexpr std::size_t kOftener = 10;  // at most, rows are alike by chance than they are but nearly alike
  std::vector<Pair> pairs;
  std::size_t by_chance = 0;
  for (const auto& [key, all] : placements) {
    const std::vector<std::size_t> rows = with_numbers(frames, all);
    by_chance += coincidences(frames, rows);
    for (const Pair& pair : equal_numbers(frames, rows)) pairs.push_back(pair);
  }
  return pairs.size() >= kFewestRows && pairs.size() > kOftener * by_chance ? pairs : std::vector<Pair>{};
}

bool are_of_one_condition(const FrameRecord& a, const FrameRecord& b) {
  return a.liquid == b.liquid && a.fill_m == b.fill_m && a.distance_m == b.distance_m && a.lateral_m == b.lateral_m;
}

std::size_t number_of_conditions(const std::vector<FrameRecord>& frames) {
  std::set<std::tuple<std::string, double, double, double>> conditions;
  for (const FrameRecord& f : frames) conditions.emplace(f.liquid, f.fill_m, f.distance_m, f.lateral_m);
  return conditions.size();
}

/// Whether all frames but the first of each of so many groups are repeated ones: then nothing scatters there.
template <class AreTogether>
bool are_all_alike(const std::vector<FrameRecord>& frames, const std::vector<Pair>& pairs, std::size_t groups,
                   const AreTogether& are_together) {
  const auto repeated = static_cast<std::size_t>(std::count_if(
      pairs.begin(), pairs.end(), [&](const Pair& p) { return are_together(frames[p.row], frames[p.earlier]); }));
  return frames.size() > groups && repeated == frames.size() - groups;
}

/// Whether clouds that differ, one after the other in a session, differ nearly everywhere: in the desk, too.
bool does_desk_scatter(const std::vector<FrameRecord>& frames, std::span<const CloudPrint> prints) {
  constexpr int kFewest = 8;             // parts of images
  constexpr double kByCupsAlone = 0.25;  // of the parts are alike at least where only cups were moved
  int compared = 0, alike = 0;
  const CloudPrint* before = nullptr;
  int session = 0;
  for (std::size_t row = 0; row < frames.size(); ++row) {
    if (prints[row].whole == 0) continue;
    if (before && frames[row].session == session && prints[row].whole != before->whole)
      for (std::size_t part = 0; part < before->parts.size(); ++part) {
        const bool are_there = before->parts[part] != 0 && prints[row].parts[part] != 0;
        compared += are_there;
        alike += are_there && before->parts[part] == prints[row].parts[part];
      }
    before = &prints[row];
    session = frames[row].session;
  }
  return compared >= kFewest && alike < kByCupsAlone * compared;
}

/// All that a row without a cloud says of a measurement but when it was made.
auto numbers_of(const FrameRecord& f) {
  return std::tuple(f.pour, f.placement, f.trial, f.liquid, f.fill_m, f.distance_m, f.lateral_m, *f.height_mm,
                    *f.height_sd_mm, *f.points);
}

}  // namespace

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

Copies find_copies(const std::vector<FrameRecord>& frames, std::span<const CloudPrint> prints) {
  PlacementRows placements;
  for (std::size_t row = 0; row < frames.size(); ++row) placements[placement_of(frames[row])].push_back(row);
  std::vector<Pair> pairs = equal_clouds(frames, prints);
  for (const Pair& pair : equal_rows(frames, placements)) pairs.push_back(pair);

  const bool may_be_without = !does_desk_scatter(frames, prints);
  const bool is_without_noise =
      may_be_without && are_all_alike(frames, pairs, placements.size(), [](const FrameRecord& a, const FrameRecord& b) {
        return placement_of(a) == placement_of(b);
      });
  const bool is_without_errors =
      may_be_without && are_all_alike(frames, pairs, number_of_conditions(frames), are_of_one_condition);

  Copies copies{std::vector<bool>(frames.size()), {}};
  std::size_t repeated = 0;
  std::vector<std::string> contradictions;  // names of frames
  for (const auto& [row, earlier] : pairs) {
    const bool is_contradiction = !are_of_one_condition(frames[row], frames[earlier]);
    if (!is_contradiction && (is_without_noise || is_without_errors)) continue;
    copies.left_out[row] = true;
    repeated += !is_contradiction;
    if (!is_contradiction) continue;
    copies.left_out[earlier] = true;
    contradictions.push_back(fmt::format("{} and {}", frames[earlier].frame, frames[row].frame));
  }
  if (repeated > 0)
    copies.mistakes.push_back(
        {"duplicated_trial", fmt::format("{} of {} frames are copies of others.", repeated, frames.size())});
  if (!contradictions.empty())
    copies.mistakes.push_back(
        {"duplicated_trial",
         fmt::format("Frames {}{} have the same cloud, but another liquid, fill or place: none of them counts.",
                     contradictions.front(),
                     contradictions.size() > 1 ? fmt::format(", and {} more pairs,", contradictions.size() - 1) : "")});
  return copies;
}

std::size_t rows_repeated(const std::vector<FrameRecord>& frames, std::span<const CloudPrint> prints,
                          const std::vector<FrameRecord>& earlier, std::span<const CloudPrint> earlier_prints) {
  std::set<std::uint64_t> clouds;
  for (const CloudPrint& print : earlier_prints) clouds.insert(print.whole);
  std::set<decltype(numbers_of(frames.front()))> numbers;
  for (const FrameRecord& f : earlier)
    if (has_numbers(f)) numbers.insert(numbers_of(f));
  const auto same_clouds = static_cast<std::size_t>(
      std::ranges::count_if(prints, [&](const CloudPrint& p) { return p.whole != 0 && clouds.contains(p.whole); }));
  const auto same_rows = static_cast<std::size_t>(std::ranges::count_if(frames, [&](const FrameRecord& f) {
    return has_numbers(f) && *f.height_sd_mm > 0.0 && numbers.contains(numbers_of(f));
  }));
  return (does_desk_scatter(frames, prints) ? same_clouds : 0) + (same_rows >= kFewestRows ? same_rows : 0);
}

}  // namespace fathom
