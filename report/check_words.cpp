#include "report/check_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "diagnosis/decision/sufficiency.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/measurement/sensed_frame.h"

namespace fathom {
namespace {

/// "fill_sigma_mm 0.5"
std::string with_default(const std::string& key) {
  const LaboratoryRig usual;
  if (key == "fill_sigma_mm") return fmt::format("{} {:g}", key, mm_from_metres(usual.fill_sigma_m));
  if (key == "placement_sigma_mm") return fmt::format("{} {:g}", key, mm_from_metres(usual.placement_sigma_m));
  if (key == "session_mm") return fmt::format("{} {:g}", key, mm_from_metres(usual.session_m));
  if (key == "session_deg") return fmt::format("{} {:.3g}", key, deg_from_radians(usual.session_rad));
  for (const RigValue& value : kRigValues)
    if (key == value.key) return fmt::format("{} {:g}", key, value.usual_sigma);
  return key;
}

/// Sentences with {names} where a Shortfall's own words and numbers stand.
struct LackText {
  Lack lack;
  std::string_view id, what, costs, remedy;
};

constexpr std::string_view kPoseCosts =
    "A diagnosis will name the sensor's pose before anything else, and may mistake other effects for it.";

constexpr std::array kTexts{
    LackText{Lack::conditions, "conditions", "There are {size:.0f} conditions (liquid, fill, distance, lateral).",
             "The verdict will be insufficient: at least {fewest_conditions} are needed.",
             "Measure the cup at other places and with other fillings."},
    LackText{Lack::desk_height, "desk_height",
             "By the clouds the sensor's height above the desk is {off:.1f} mm {more} than in rig.json.", kPoseCosts,
             "Measure height_mm anew."},
    LackText{Lack::desk_pitch, "desk_pitch", "By the clouds the sensor's pitch is {off:.2f}° {more} than in rig.json.",
             kPoseCosts, "Measure pitch_deg anew."},
    LackText{Lack::desk_roll, "desk_roll", "By the clouds the sensor's roll is {off:.2f}° {more} than in rig.json.",
             kPoseCosts, "Measure roll_deg anew."},
    LackText{Lack::desk_in_sight, "desk_in_sight",
             "{count} of {looked_at} clouds that were looked at {no_desk}: frames {names}.",
             "Such clouds do not count.", "Look at these clouds, and at their places in the table."},
    LackText{Lack::cup_in_sight, "cup_in_sight",
             "{count} of {looked_at} clouds that were looked at {no_cup}: frames {names}.", "Such clouds do not count.",
             "Look at distance_mm and lateral_mm of these frames."},
    LackText{
        Lack::cup_in_image, "cup_in_image",
        "Cups reach out of the image at {count} places ({names}); at worst {percent:.0f} % of the cup's outline is "
        "in it.",
        "What is not seen of a cup is compared with nothing, and its walls say less of where it stands.",
        "Put these cups nearer to the middle of the image."},
    LackText{Lack::inside_in_sight, "inside_in_sight",
             "In {count} conditions next to nothing is seen of the cup's inside, {size:.0f} pixels at worst: {names}.",
             "No height is compared there. What lies within 10 mm of the inner wall does not count as seen.",
             "Put the cup nearer to the sensor's foot, or fill it higher."},
    LackText{Lack::whole_clouds, "whole_clouds",
             "{count} clouds are less than half as large as the others: frames {names}.",
             "A file that broke off stops a diagnosis.", "Copy these files anew."},
    LackText{Lack::clouds, "clouds", "{size:.0f} of {frames} frames have a height and no cloud.",
             "Only mean heights are compared there. A unit's own error at each place stays unknown: only contrasts "
             "between fillings at one place are free of it.",
             "Keep the clouds, and name them in the column cloud."},
    LackText{Lack::bare_desk_views, "bare_desk_views", "There are no views of the bare desk.",
             "{bias}, about {size:.1f} mm where these cups stand, cannot be learned there.",
             "Take three views without a cup before the first cup is put down: liquid none, all lengths 0."},
    LackText{Lack::repeats, "repeats", "Hardly anything was measured twice.",
             "The size of the errors can then only be estimated from how smoothly the heights vary; with fewer than 24 "
             "of them the verdict is insufficient.",
             "Pour each filling twice, put each cup down twice, and take three shots of each placement."},
    LackText{Lack::trials, "trials", "Each placement has one shot.",
             "The sensor's noise cannot be told from errors of placing, nor does a trembling sensor show.",
             "Take three shots of each placement."},
    LackText{Lack::placements, "placements", "No cup was put down twice at one place with one filling.",
             "What putting down does is taken to be {placement_mm:g} mm, as rig.json says or by default.",
             "Lift each cup once and put it down again."},
    LackText{Lack::pours, "pours", "{count} fillings were poured once: {names}.",
             "An error of that pour, {fill_mm:g} mm (1 σ) by rig.json or by default, looks like an effect of its "
             "liquid.",
             "Pour each filling twice or more."},
    LackText{Lack::empty_cup, "empty_cup", "There is no empty cup.",
             "A bottom that lies higher cannot be told from liquids that are deeper than written down.",
             "Take the empty cup at each place."},
    LackText{Lack::fills, "fills", "Of {names} there is one depth alone.",
             "An error that all fills share cannot be told from one that grows with them, nor from another refractive "
             "index.",
             "Take two depths, far apart."},
    LackText{Lack::distances, "distances", "All cups stand at one distance.",
             "Another refractive index looks like fills that are off in proportion, and a sensor's errors like the "
             "cup's.",
             "Take two distances or more, 100 mm apart."},
    LackText{Lack::laterals, "laterals", "All cups have the same lateral position.",
             "What differs from left to right does not show.", "Take cups to the left and to the right as well."},
    LackText{Lack::sessions, "sessions", "There is one session.",
             "What changes when the sensor is set up anew does not show.", "Take a second session on another day."},
    LackText{Lack::times, "times", "All frames have the same time_s.", "Warming up and evaporation do not show.",
             "Write down when each shot was taken, in seconds of its session."},
    LackText{Lack::brightness, "brightness", "Clouds have no intensity.",
             "Foam, scattering and absorption show in heights alone.",
             "Write the infrared image's values as the field intensity of the clouds."},
    LackText{Lack::stated_sigmas, "stated_sigmas",
             "rig.json does not say how certain some values are. These standard deviations are used: {defaults}.",
             "If the rig is less certain than that, its errors are named as effects.",
             "State those of sensor and cup under sigma, the others as {beside}."},
};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kTexts.size(); ++i)
    if (kTexts[i].lack != static_cast<Lack>(i)) return false;
  return kTexts.back().lack == Lack::stated_sigmas;
}
static_assert(is_in_order());

}  // namespace

LackWords lack_words(const Shortfall& s, const MeasurementCheck& check) {
  std::vector<std::string> defaults;
  for (const std::string& key : s.names) defaults.push_back(with_default(key));
  const LackText& text = kTexts[static_cast<std::size_t>(s.lack)];
  const auto filled = [&](std::string_view sentence) {
    return fmt::format(
        fmt::runtime(sentence), fmt::arg("size", s.size), fmt::arg("percent", 100.0 * s.size),
        fmt::arg("off", std::abs(s.size)), fmt::arg("more", s.size > 0.0 ? "more" : "less"),
        fmt::arg("count", s.names.size()), fmt::arg("names", name_list(s.names)),
        fmt::arg("defaults", fmt::join(defaults, ", ")), fmt::arg("looked_at", check.clouds_read),
        fmt::arg("frames", check.frames), fmt::arg("no_desk", kNoDesk.finding), fmt::arg("no_cup", kNoCup.finding),
        fmt::arg("fewest_conditions", kFewestConditions),
        fmt::arg("placement_mm", mm_from_metres(check.rig.placement_sigma_m)),
        fmt::arg("fill_mm", mm_from_metres(check.rig.fill_sigma_m)),
        fmt::arg("bias", check.rig.unit.map ? "What calibration left of the unit's own bias" : "The unit's own bias"),
        fmt::arg("beside", check.sessions > 1 ? "fill_sigma_mm, placement_sigma_mm, session_mm and session_deg"
                                              : "fill_sigma_mm and placement_sigma_mm"));
  };
  return {text.id, filled(text.what), filled(text.costs), filled(text.remedy)};
}

}  // namespace fathom
