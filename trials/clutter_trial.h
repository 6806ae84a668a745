// One random desk: shot once, searched for cups by any number of methods, and what was found beside what stands there.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "detector/detector.h"
#include "sim/scene/setup.h"
#include "sim/sensor/capture.h"

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
  std::string kind;             ///< "transparent" or "opaque"; of an empty cup ""
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
  std::string name;  ///< its number, as its files are called; they do not hold it
  std::vector<TrialCup> cups;
  std::vector<std::string> false_cups;  ///< what was taken for a cup
  double shoot_s = 0.0, detect_s = 0.0;
  std::map<std::string, double> stages_s;  ///< of the method
};

/// To and from the file that keeps a trial.
Json json_of(const TrialResult& result);
TrialResult trial_from_json(const JsonReader& json);

/// A random desk as the sensor saw it.
struct TrialShot {
  Setup setup;
  Camera camera;
  Frame frame;
  Cloud cloud;                  ///< the frame's, as detectors take it
  std::vector<double> visible;  ///< of each cup the share of the pixels it would fill alone on the desk
  double shoot_s;
};

/// Where the sensor stands.
DeskPrior prior_of(const Rig& rig);

/// Photometric, direct light.
TrialShot shoot_trial(const Json& scene, const std::string& file, std::uint64_t seed);

struct Trial {
  Detection detection;
  TrialResult result;
};

/// `settings`' prior is set to where the sensor stands.
Trial search_trial(const TrialShot& shot, const Method& method, DetectorSettings settings);

}  // namespace fathom
