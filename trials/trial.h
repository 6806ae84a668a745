// One frame of a desk of which it is known what stands there: searched for cups by any method, and what was found
// beside what is true.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/json.h"
#include "core/pose.h"
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
  std::string kind;             ///< "transparent" or "opaque"; of an empty cup ""
  Eigen::Vector2d position_mm;  ///< of its axis, world
  double distance_mm = 0.0;     ///< of its foot from the camera
  double visible = 0.0;         ///< pixels in which it is seen, as a share of those that it would fill alone
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
  int others = 0;                       ///< how many other things stand there
  std::string sensor;                   ///< its model
  double shoot_s = 0.0, detect_s = 0.0;
  std::map<std::string, double> stages_s;  ///< of the method
};

/// What came of some cups.
struct CupCounts {
  int cups = 0, found = 0;
  int liquid = 0, unknown = 0;               ///< found cups whose content was called liquid, or could not be told
  std::array<int, kMisses.size()> missed{};  ///< in the order of kMisses
  int false_cups = 0;

  void add(const TrialCup& cup);
  CupCounts& operator+=(const CupCounts& other);
};

CupCounts counts_of(const std::vector<TrialResult>& trials);

/// To and from the file that keeps a trial.
Json json_of(const TrialResult& result);
TrialResult trial_from_json(const JsonReader& json);

/// What a sensor saw, and what is true of it.
struct LabelledFrame {
  std::string sensor;  ///< its model
  Pose world_from_camera;
  double focal_px;
  Eigen::Vector2d principal_px;  ///< of an image whose first pixel has its centre at (0.5, 0.5)
  Cloud cloud{};
  std::vector<TrialCup> cups{};       ///< what stands there, nothing found
  std::vector<std::string> others{};  ///< names of the other things
  Image<int> owners;                  ///< of each pixel the cup that it shows, or after these the other thing; kNobody

  static constexpr int kNobody = -1;
};

/// Where the sensor stands.
DeskPrior prior_of(const Pose& world_from_camera);

struct Trial {
  Detection detection;
  TrialResult result;
};

/// `settings`' prior is set to where the sensor stands.
Trial search_trial(const LabelledFrame& frame, const Method& method, DetectorSettings settings);

}  // namespace fathom
