#include <fmt/format.h>

#include "core/image_file.h"
#include "core/json.h"
#include "core/units.h"
#include "diagnosis/unit/calibration.h"

namespace fathom {
namespace {

constexpr const char* kImage = "unit_bias.exr";

std::string channel_of_pose(std::size_t pose) { return fmt::format("pose_{}_px", pose); }

Json json_from(const UnitCalibration& unit) {
  Json poses = Json::array();
  for (std::size_t i = 0; i < unit.poses.size(); ++i)
    poses.push_back({{"channel", channel_of_pose(i)},
                     {"clouds", unit.poses[i].clouds},
                     {"height_mm", unit.poses[i].height_mm},
                     {"pitch_deg", unit.poses[i].pitch_deg},
                     {"roll_deg", unit.poses[i].roll_deg}});
  Json json = {{"source", fmt::format("fathom calibrate: {} clouds, {} views", unit.clouds, unit.views)},
               {"device",
                {{"focal_px", unit.scale.focal_px},
                 {"baseline_mm", mm_from_metres(unit.scale.baseline_m)},
                 {"image_focal_px", unit.image_focal_px},
                 {"camera_mm", mm_from_metres(unit.scale.camera_m)}}},
               {"bias",
                {{"image", kImage},
                 {"reference_at_px", unit.reference_at_px},
                 {"without_px", unit.without_px},
                 {"left_px", unit.left_px},
                 {"poses", poses}}},
               {"prior",
                {{"reach_px", kBiasReaches_px},
                 {"reference_px", unit.prior.reference_px},
                 {"camera_px", unit.prior.camera_px},
                 {"pose_px", unit.prior.state_px},
                 {"cell_px", unit.prior.cell_px},
                 {"columns_px", unit.prior.columns_px}}},
               {"noise",
                {{"sigma_px", unit.noise.sigma_px},
                 {"lags_px", kNoiseLags_px},
                 {"along_rows", unit.noise.along_rows},
                 {"along_columns", unit.noise.along_columns}}},
               {"depths",
                {{"step_px", unit.depths.step_px},
                 {"phase", unit.depths.phase},
                 {"codes_per_step", unit.depths.codes_per_step},
                 {"cut_mm", unit.depths.cut_mm},
                 {"on_law", unit.depths.on_law}}}};
  if (unit.warm_up)
    json["warm_up"] = {{"warm_up_px", unit.warm_up->warm_up_px},
                       {"warm_up_s", unit.warm_up->warm_up_s},
                       {"sigma_px", unit.warm_up->sigma_px}};
  return json;
}

}  // namespace

void write_unit(const std::filesystem::path& folder, const UnitCalibration& unit) {
  std::vector<ExrChannel> channels{{"bias_px", unit.bias_px},
                                   {"sigma_px", unit.sigma_px},
                                   {"reference_px", unit.reference_px},
                                   {"camera_px", unit.camera_px}};
  for (std::size_t i = 0; i < unit.poses.size(); ++i) channels.push_back({channel_of_pose(i), unit.poses[i].bias_px});
  write_exr(folder / kImage, channels);
  write_json(folder / "unit.json", json_from(unit));
}

}  // namespace fathom
