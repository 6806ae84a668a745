#include "app/check_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "diagnosis/measurement/named_values.h"
#include "diagnosis/predict/uncertain_rig.h"
#include "diagnosis/statistics/sufficiency.h"

namespace fathom {
namespace {

/// "1, 2, 3, 4, 5 and 12 more"
std::string list(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 5;
  const std::size_t shown = std::min(names.size(), kNamed);
  const std::string text = fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<long>(shown), ", "));
  return names.size() > shown ? fmt::format("{} and {} more", text, names.size() - shown) : text;
}

/// "fill_sigma_mm 0.5"
std::string with_default(const std::string& key) {
  const LaboratoryRig usual;
  if (key == "fill_sigma_mm") return fmt::format("{} {:g}", key, mm_from_metres(usual.fill_sigma_m));
  if (key == "placement_sigma_mm") return fmt::format("{} {:g}", key, mm_from_metres(usual.placement_sigma_m));
  for (const UncertainValue& value : kUncertainRig)
    if (key == value.key) return fmt::format("{} {:g}", key, value.sigma);
  return key;
}

/// `value` of the sensor as it is called in a sentence, `off` with its unit.
LackWords pose(std::string_view id, const char* value, double off, const std::string& size, const char* key) {
  return {
      id,
      fmt::format("By the clouds the sensor's {} is {} {} than in rig.json.", value, size, off > 0.0 ? "more" : "less"),
      "A diagnosis will name the sensor's pose before anything else, and may mistake other effects for it.",
      fmt::format("Measure {} anew.", key)};
}

}  // namespace

LackWords lack_words(const Shortfall& s, const MeasurementCheck& check) {
  const auto size = static_cast<std::size_t>(s.size);
  switch (s.lack) {
    case Lack::conditions:
      return {"conditions", fmt::format("There are {} conditions (liquid, fill, distance, lateral).", size),
              fmt::format("The verdict will be insufficient: at least {} are needed.", kFewestConditions),
              "Measure the cup at other places and with other fillings."};
    case Lack::desk_height:
      return pose("desk_height", "height above the desk", s.size, fmt::format("{:.1f} mm", std::abs(s.size)),
                  "height_mm");
    case Lack::desk_pitch:
      return pose("desk_pitch", "pitch", s.size, fmt::format("{:.2f}°", std::abs(s.size)), "pitch_deg");
    case Lack::desk_roll:
      return pose("desk_roll", "roll", s.size, fmt::format("{:.2f}°", std::abs(s.size)), "roll_deg");
    case Lack::desk_in_sight:
      return {"desk_in_sight",
              fmt::format("{} of {} clouds that were looked at show no desk where rig.json says it is: frames {}.",
                          s.names.size(), check.clouds_read, list(s.names)),
              "Such clouds do not count.", "Look at these clouds, and at their places in the table."};
    case Lack::cup_in_sight:
      return {
          "cup_in_sight",
          fmt::format("{} of {} clouds that were looked at show the bare desk where the cup should stand: frames {}.",
                      s.names.size(), check.clouds_read, list(s.names)),
          "Such clouds do not count.", "Look at distance_mm and lateral_mm of these frames."};
    case Lack::cup_in_image:
      return {
          "cup_in_image",
          fmt::format("Cups reach out of the image at {} places ({}); at worst {:.0f} % of the cup's outline is in it.",
                      s.names.size(), list(s.names), 100.0 * s.size),
          "What is not seen of a cup is compared with nothing, and its walls say less of where it stands.",
          "Put these cups nearer to the middle of the image."};
    case Lack::inside_in_sight:
      return {"inside_in_sight",
              fmt::format("In {} conditions next to nothing is seen of the cup's inside, {:.0f} pixels at worst: {}.",
                          s.names.size(), s.size, list(s.names)),
              fmt::format("No height is compared there: a region counts from {:g} pixels on, and 10 mm along the inner "
                          "wall are left out.",
                          kFewestInRegion),
              "Put the cup nearer to the sensor's foot, or fill it higher."};
    case Lack::whole_clouds:
      return {
          "whole_clouds",
          fmt::format("{} clouds are less than half as large as the others: frames {}.", s.names.size(), list(s.names)),
          "A file that broke off stops a diagnosis.", "Copy these files anew."};
    case Lack::clouds:
      return {"clouds", fmt::format("{} of {} frames have a height and no cloud.", size, check.frames),
              "Only mean heights are compared there. A unit's own error at each place stays unknown: only contrasts "
              "between fillings at one place are free of it.",
              "Keep the clouds, and name them in the column cloud."};
    case Lack::bare_desk_views:
      return {
          "bare_desk_views", "There are no views of the bare desk.",
          fmt::format("The unit's own bias, about {:.1f} mm where these cups stand, cannot be learned there.", s.size),
          "Take three views without a cup before the first cup is put down: liquid none, all lengths 0."};
    case Lack::repeats:
      return {"repeats", "Nothing was measured twice.",
              "How large errors are has to be taken from how smooth heights are, or the verdict is insufficient.",
              "Take three shots of each placement, and put each cup down twice."};
    case Lack::trials:
      return {"trials", "Each placement has one shot.",
              "The sensor's noise cannot be told from errors of placing, nor does a trembling sensor show.",
              "Take three shots of each placement."};
    case Lack::placements:
      return {"placements", "No cup was put down twice at one place with one filling.",
              fmt::format("What putting down does is taken to be {:g} mm, as rig.json says or by default.",
                          mm_from_metres(check.rig.placement_sigma_m)),
              "Lift each cup once and put it down again."};
    case Lack::pours:
      return {"pours", fmt::format("{} fillings were poured once: {}.", s.names.size(), list(s.names)),
              fmt::format("An error of that pour, {:g} mm (1 σ) by rig.json or by default, looks like an effect of its "
                          "liquid.",
                          mm_from_metres(check.rig.fill_sigma_m)),
              "Pour each filling twice or more."};
    case Lack::empty_cup:
      return {"empty_cup", "There is no empty cup.",
              "A bottom that lies higher cannot be told from liquids that are deeper than written down.",
              "Take the empty cup at each place."};
    case Lack::fills:
      return {"fills", fmt::format("Of {} there is one depth alone.", list(s.names)),
              "An error that all fills share cannot be told from one that grows with them, nor from another refractive "
              "index.",
              "Take two depths, far apart."};
    case Lack::distances:
      return {"distances", "All cups stand at one distance.",
              "Another refractive index looks like fills that are off in proportion, and a sensor's errors like the "
              "cup's.",
              "Take two distances or more, 100 mm apart."};
    case Lack::laterals:
      return {"laterals", "All cups stand at one lateral.", "What differs from left to right does not show.",
              "Take cups to the left and to the right as well."};
    case Lack::sessions:
      return {"sessions", "There is one session.", "What changes when the sensor is set up anew does not show.",
              "Take a second session on another day."};
    case Lack::times:
      return {"times", "All frames have the same time_s.", "Warming up and evaporation do not show.",
              "Write down when each shot was taken, in seconds of its session."};
    case Lack::brightness:
      return {"brightness", "Clouds have no intensity.", "Foam, scattering and absorption show in heights alone.",
              "Write the infrared image's values as the field intensity of the clouds."};
    case Lack::stated_sigmas: {
      std::vector<std::string> keys;
      for (const std::string& key : s.names) keys.push_back(with_default(key));
      return {"stated_sigmas",
              fmt::format("rig.json does not say how certain some values are; taken are {}.", fmt::join(keys, ", ")),
              "If the rig is less certain than that, its errors are named as effects.",
              "State them under sigma, as fill_sigma_mm and as placement_sigma_mm."};
    }
  }
  return {};
}

}  // namespace fathom
