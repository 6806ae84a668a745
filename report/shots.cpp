#include "report/shots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include "core/input_policy.h"
#include "diagnosis/measurement/cup_in_sight.h"
#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/measurement/frame_cloud.h"
#include "diagnosis/measurement/read_measurement.h"
#include "report/observable_words.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// The part of an infrared image that a box of an image of 640 x 480 is about, with a third of its size around it.
Eigen::AlignedBox2i around(const Eigen::AlignedBox2d& box, const Image<float>& image) {
  constexpr double kMargin = 1.0 / 3.0;
  const double scale = image.width() / static_cast<double>(kImageWidth_px);
  const Eigen::Vector2d offset(0.0, 0.5 * (image.height() - scale * kImageHeight_px));
  const Eigen::Vector2d margin = kMargin * box.sizes();
  const Eigen::AlignedBox2i part((scale * (box.min() - margin) + offset).cast<int>(),
                                 (scale * (box.max() + margin) + offset).cast<int>());
  return part.intersection(
      Eigen::AlignedBox2i(Eigen::Vector2i::Zero(), Eigen::Vector2i(image.width() - 1, image.height() - 1)));
}

Image<std::uint8_t> picture(const Image<float>& image, const Eigen::AlignedBox2i& part) {
  constexpr double kWhite = 0.99;
  if (part.isEmpty()) return {};
  const Eigen::Vector2i size = part.sizes() + Eigen::Vector2i::Ones();
  std::vector<float> sorted;
  for (int y = 0; y < size.y(); ++y)
    sorted.insert(sorted.end(), image.row(part.min().y() + y) + part.min().x(),
                  image.row(part.min().y() + y) + part.min().x() + size.x());
  const auto white = sorted.begin() + static_cast<std::ptrdiff_t>(kWhite * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), white, sorted.end());
  const float gain = 255.0f / std::max(*white, 1.0f);
  Image<std::uint8_t> result(size.x(), size.y());
  for (int y = 0; y < size.y(); ++y)
    for (int x = 0; x < size.x(); ++x)
      result(x, y) =
          static_cast<std::uint8_t>(std::clamp(gain * image(part.min().x() + x, part.min().y() + y), 0.0f, 255.0f));
  return result;
}

ReportShot shot_of(const FrameRecord& frame, const LaboratoryRig& rig, const fs::path& folder, const fs::path& report,
                   const Factors& factors) {
  ReportShot shot{
      frame.frame, condition_words(factors), fs::relative(folder / frame.cloud, report).generic_string(), {}};
  if (frame.infrared.empty()) return shot;
  const Eigen::AlignedBox2d box = cup_in_image({frame.lateral_m, frame.distance_m}, rig);
  if (box.isEmpty()) return shot;
  const Image<float> image =
      read_infrared(path_named_in((folder / "frames.csv").string(), "column 'ir'", frame.infrared));
  shot.infrared = picture(image, around(box, image));
  return shot;
}

}  // namespace

ReportShots shots_of(const std::vector<Observation>& observations, const Measurement& measurement,
                     const std::vector<fs::path>& folders, const fs::path& report) {
  ReportShots result{{}, std::vector<int>(observations.size(), -1)};
  // Numbers of pours and placements may start anew with each filling and place.
  using Key = std::tuple<int, int, int, std::string, std::int64_t, std::int64_t, std::int64_t>;
  const auto key_of = [](const Factors& f) {
    const auto micrometres = [](double mm) { return static_cast<std::int64_t>(std::llround(1000.0 * mm)); };
    return Key(f.session, f.pour, f.placement, f.liquid, micrometres(f.fill_mm), micrometres(f.distance_mm),
               micrometres(f.lateral_mm));
  };
  std::map<Key, const FrameRecord*> first;
  for (const FrameRecord& f : measurement.frames)
    if (!f.cloud.empty()) first.emplace(key_of(factors_of(f)), &f);
  std::map<const FrameRecord*, int> numbers;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Factors& f = observations[i].factors;
    const auto found = first.find(key_of(f));
    if (observations[i].observable != "height_mm" || found == first.end()) continue;
    const auto [number, is_new] = numbers.emplace(found->second, static_cast<int>(result.shots.size()));
    if (is_new)
      result.shots.push_back(shot_of(*found->second, measurement.rig, folders[found->second->folder], report, f));
    result.of[i] = number->second;
  }
  return result;
}

}  // namespace fathom
