#include "diagnosis/measurement/named_values.h"

#include <cmath>
#include <optional>
#include <string>

#include "core/units.h"

namespace fathom {

std::vector<NamedValue> named_values(const FrameEstimates& estimates) {
  // Pixels; fewer are no evidence, and of a region no more than the edge of a shadow.
  constexpr double kFewestInside = 10.0, kFewestOnDesk = 100.0;
  constexpr std::string_view kDesk = "desk";
  std::vector<NamedValue> values;
  for (std::size_t i = 0; i < estimates.height.size(); ++i)
    if (const RegionEstimate& region = estimates.height[i]; region.weight >= kFewestInRegion) {
      values.push_back({"height_mm", kCupRegionNames[i], mm_from_metres(region.mean), region.weight});
      values.push_back({"stray_share", kCupRegionNames[i], region.stray_share()});
    }
  if (estimates.interior.weight >= kFewestInside) {
    values.push_back({"height_sd_mm", kWholeInterior, mm_from_metres(estimates.interior.sd)});
    const double inside = estimates.interior_intensity.mean, desk = estimates.desk_intensity.mean;
    if (inside > 0.0 && desk > 0.0) values.push_back({"log_brightness", kWholeInterior, std::log(inside / desk)});
  }
  const std::optional<double>&desk_dots = estimates.desk_contrast, &dots = estimates.interior_contrast;
  const bool sees_desk = desk_dots && estimates.desk_intensity.mean > 0.0;
  const bool sees_inside = dots && estimates.interior_intensity.mean > 0.0;
  constexpr double kLeastOfDots = 0.15;  // shading and a colour image's grain are below
  if (sees_desk && sees_inside && *desk_dots > kLeastOfDots && *dots > 0.0 &&
      estimates.interior.weight >= kFewestInRegion)
    values.push_back({"log_ir_contrast", kWholeInterior, std::log(*dots / *desk_dots)});
  if (estimates.outline) {
    constexpr std::string_view kWalls = "walls";
    const CupOutline& outline = *estimates.outline;
    values.push_back({"cup_x_mm", kWalls, mm_from_metres(outline.off.x()), outline.pixels.x()});
    values.push_back({"cup_y_mm", kWalls, mm_from_metres(outline.off.y()), outline.pixels.y()});
    values.push_back({"cup_radius_mm", kWalls, mm_from_metres(outline.wider), outline.pixels.z()});
  }
  values.push_back({"desk_height_mm", kDesk, mm_from_metres(estimates.desk.offset)});
  values.push_back({"desk_pitch_deg", kDesk, deg_from_radians(pitch_above(estimates.desk))});
  values.push_back({"desk_roll_deg", kDesk, deg_from_radians(roll_above(estimates.desk))});
  for (std::size_t i = 0; i < estimates.desk_residual.size(); ++i)
    if (estimates.desk_residual[i].weight >= kFewestOnDesk)
      values.push_back({"desk_residual_mm", kDeskRegionNames[i], mm_from_metres(estimates.desk_residual[i].mean),
                        estimates.desk_residual[i].weight});
  values.push_back({"comb_strength", kDesk, estimates.step_comb});
  if (estimates.spans_codes) {
    values.push_back({"comb_quarter", kDesk, estimates.coarse_combs[0]});
    values.push_back({"comb_half", kDesk, estimates.coarse_combs[1]});
  }
  values.push_back({"millimetre_comb", kDesk, estimates.millimetre_comb});
  for (int i = 0; i < kCupCells; ++i)
    if (const RegionEstimate& cell = estimates.cell_height[i]; is_surface(cell))
      values.push_back({"cell_height_mm", name_of_cell(i), mm_from_metres(cell.mean), cell.weight});
  return values;
}

bool is_surface(const RegionEstimate& cell) { return cell.weight >= kFewestInCell && cell.stray_share() <= kMostStray; }

std::string_view name_of_cell(int cell) {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (int i = 0; i < kCupCells; ++i) all.push_back("cell " + std::to_string(i));
    return all;
  }();
  return names[cell];
}

}  // namespace fathom
