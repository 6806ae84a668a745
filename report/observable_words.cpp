#include "report/observable_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace fathom {
namespace {

constexpr std::array kWords{
    ObservableWords{"height_mm", "height in the cup", " mm", "higher", "lower"},
    ObservableWords{"content_shape_mm", "shape of what is seen in the cup", " mm", "higher", "lower"},
    ObservableWords{"stray_share", "share of heights far from their median in the cup", "", "larger", "smaller"},
    ObservableWords{"height_sd_mm", "scatter of the heights in the cup", " mm", "wider", "narrower"},
    ObservableWords{"log_brightness", "logarithm of the brightness in the cup", "", "higher", "lower"},
    ObservableWords{"log_ir_contrast", "logarithm of the contrast of the infrared's dots in the cup", "", "higher",
                    "lower"},
    ObservableWords{"cup_x_mm", "sideways place of the cup", " mm", "further right", "further left"},
    ObservableWords{"cup_y_mm", "distance of the cup", " mm", "larger", "smaller"},
    ObservableWords{"cup_radius_mm", "radius of the cup", " mm", "larger", "smaller"},
    ObservableWords{"desk_height_mm", "height of the camera above the desk", " mm", "larger", "smaller"},
    ObservableWords{"desk_pitch_deg", "pitch of the camera", "°", "steeper", "flatter"},
    ObservableWords{"desk_roll_deg", "roll of the camera", "°", "larger", "smaller"},
    ObservableWords{"desk_residual_mm", "height of the desk above its plane", " mm", "higher", "lower"},
    ObservableWords{"liquid_motion_mm", "extra scatter from shot to shot of heights read through a liquid", " mm",
                    "wider", "narrower"},
    ObservableWords{"desk_wander_mm", "wander of the desk from shot to shot", " mm", "wider", "narrower"},
    ObservableWords{"desk_pitch_motion_deg", "motion of the camera's pitch from shot to shot", "°", "wider",
                    "narrower"},
    ObservableWords{"desk_roll_motion_deg", "motion of the camera's roll from shot to shot", "°", "wider", "narrower"},
    ObservableWords{"desk_waves_px", "waves across the desk from shot to shot", " px", "higher", "lower"},
    ObservableWords{"desk_rows_px", "scatter of the image's rows", " px", "wider", "narrower"},
    ObservableWords{"desk_columns_px", "scatter of the image's columns", " px", "wider", "narrower"},
    ObservableWords{"comb_strength", "degree to which disparities keep to steps of 1/8 px", "", "higher", "lower"},
    ObservableWords{"comb_quarter", "degree to which disparities keep to steps of 1/4 px", "", "higher", "lower"},
    ObservableWords{"comb_half", "degree to which disparities keep to steps of 1/2 px", "", "higher", "lower"},
    ObservableWords{"millimetre_comb", "degree to which depths keep to whole millimetres", "", "higher", "lower"}};

}  // namespace

ObservableWords observable_words(std::string_view id) {
  const auto known = std::find_if(kWords.begin(), kWords.end(), [&](const ObservableWords& w) { return w.id == id; });
  return known != kWords.end() ? *known : ObservableWords{id, id, "", "larger", "smaller"};
}

std::string spaced(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string condition_words(const Factors& f) {
  return fmt::format("{}{}, cup at ({:g}, {:g}) mm", spaced(f.liquid),
                     f.fill_mm > 0.0 ? fmt::format(", {:g} mm", f.fill_mm) : "", f.lateral_mm, f.distance_mm);
}

}  // namespace fathom
