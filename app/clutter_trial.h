// One random desk: shot, searched for cups, and what was found beside what stands there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image_file.h"
#include "core/json.h"
#include "detector/detector.h"

namespace fathom {

/// Why a cup was not found. The paper shows one of each of the first two.
enum class Miss {
  merged,    ///< its segment holds points of other things (Fig. 17)
  occluded,  ///< other things hide much of it (Fig. 18)
  refused    ///< neither: the method looked at it and said no
};

inline constexpr std::array kMisses{Miss::merged, Miss::occluded, Miss::refused};

std::string_view name_of(Miss miss);

/// A cup that stands there.
struct TrialCup {
  std::string shape, liquid;  ///< of an empty cup "empty"
  double fill_mm = 0.0;
  Eigen::Vector2d position_mm;  ///< of its axis, world
  double visible = 0.0;         ///< share of the pixels it would fill alone on the desk
  bool found = false;
  std::string liquid_found;  ///< "yes", "no", "unknown"; of a cup that was found
  std::optional<double> surface_mm, fill_found_mm, fill_sigma_mm, p_liquid;
  std::string kind_found;
  std::optional<Miss> miss;  ///< of a cup that was not found …
  std::string why;           ///< … in the method's words
};

struct TrialResult {
  std::vector<TrialCup> cups;
  std::vector<std::string> false_cups;  ///< what was taken for a cup
  double shoot_s = 0.0, detect_s = 0.0;
};

/// To and from the file that keeps a trial.
Json json_of(const TrialResult& result);
TrialResult trial_from_json(const JsonReader& json);

struct Trial {
  TrialResult result;
  Image<Rgb> picture;  ///< as preview()
};

/// Photometric, direct light. `settings`' prior is set to where the sensor stands.
Trial run_trial(const Json& scene, const Method& method, DetectorSettings settings, std::uint64_t seed);

}  // namespace fathom
