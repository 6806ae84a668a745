#include "paper/heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "campaign/campaign_spec.h"
#include "campaign/cup_height.h"
#include "core/json.h"
#include "core/progress.h"
#include "core/rng.h"
#include "core/units.h"

namespace fathom {
namespace {

constexpr const char* kName = "the paper's scene";

/// Of the pixels that look through a liquid's surface, or at that of one that scatters, at what the projector lights.
double matched_share(const Image<TruePixel>& truth, const Image<float>& depth) {
  double lit = 0.0, matched = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TruePixel& pixel = truth.pixels()[i];
    if (pixel.path == PathKind::nothing || pixel.path == PathKind::direct || !pixel.apparent_depth) continue;
    ++lit;
    matched += depth.pixels()[i] > 0.0f;
  }
  return lit > 0.0 ? matched / lit : 0.0;
}

}  // namespace

std::string PaperFilling::label() const {
  if (liquid == "empty") return liquid;
  std::string name = liquid;
  std::replace(name.begin(), name.end(), '_', ' ');
  return fmt::format("{} {:g} mm", name, fill_mm);
}

Setup paper_setup(const PaperFilling& filling, double distance_mm, const Json& sensor) {
  Json described = {{"model", "xtion_pro_live"}, {"height_mm", kPaperHeightMm}, {"aim_mm", {0, 400, 0}}};
  described.update(sensor);
  Json cup = {{"shape", "paper_cup"}, {"position_mm", {0.0, distance_mm}}};
  if (filling.liquid != "empty") {
    cup["liquid"] = filling.liquid;
    cup["fill_mm"] = filling.fill_mm;
  }
  return setup_from_json({{"sensor", described}, {"cups", Json::array({cup})}}, kName);
}

LaboratoryRig paper_rig(const Setup& setup) {
  return nominal_rig(setup.rig, std::get<CupShape>(setup.scene.cups.front().shape), kName);
}

double water_index_at_sensor() {
  const Setup setup = paper_setup({"water", 10.0}, 400.0);
  return setup.scene.cups.front().filling->medium.n(setup.rig.sensor.wavelength_nm);
}

HeightCell measure_height(const PaperFilling& filling, double distance_mm, const HeightCapture& capture) {
  const Setup setup = paper_setup(filling, distance_mm);
  const LaboratoryRig rig = paper_rig(setup);
  Camera camera(setup, capture.mode, kDefaultSamplesPerPixel, capture.seed, capture.light);
  const int trials = capture.trials;
  HeightCell cell;
  double sum = 0.0, squares = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const Frame frame = camera.shoot(static_cast<std::uint64_t>(trial));
    cell.matched += matched_share(camera.truth(), frame.depth) / trials;
    const Cloud cloud = cloud_from_image(frame.cloud);
    const auto found = height_in_cup(cloud, rig, {0.0, metres_from_mm(distance_mm)});
    const InteriorHeight* height = std::get_if<InteriorHeight>(&found);
    if (!height) continue;
    ++cell.seen;
    cell.points += static_cast<double>(height->points) / trials;
    sum += mm_from_metres(height->mean_m);
    squares += mm_from_metres(height->mean_m) * mm_from_metres(height->mean_m);
  }
  if (cell.seen == 0) return cell;
  cell.mean_mm = sum / cell.seen;
  if (cell.seen > 1)
    cell.sd_mm = std::sqrt(std::max(0.0, squares - cell.seen * cell.mean_mm * cell.mean_mm) / (cell.seen - 1));
  return cell;
}

PaperHeights measure_paper_heights(int trials, std::uint64_t seed, bool quiet) {
  PaperHeights heights;
  Progress progress("condition", kPaperFillings.size() * kPaperDistancesMm.size(), quiet);
  for (std::size_t f = 0; f < kPaperFillings.size(); ++f)
    for (std::size_t d = 0; d < kPaperDistancesMm.size(); ++d) {
      const PaperFilling& filling = kPaperFillings[f];
      heights.rows[f][d] =
          measure_height(filling, kPaperDistancesMm[d], {.trials = trials, .seed = Rng(seed, f, d).bits()});
      if (filling.liquid == "water")
        heights.noise_free[f][d] =
            measure_height(filling, kPaperDistancesMm[d], {.mode = CaptureMode::geometric, .seed = seed});
      progress.step();
    }
  return heights;
}

}  // namespace fathom
