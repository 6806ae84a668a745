// What a detector is given and what it finds, and the table of methods.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "detector/cloud.h"
#include "detector/content.h"
#include "detector/icp.h"
#include "detector/paper_config.h"
#include "detector/plane.h"
#include "detector/robust_config.h"
#include "detector/stage_clock.h"

namespace fathom {

/// Whether what fills a cup is seen through (its bottom reads raised) or seen itself.
enum class LiquidKind { kTransparent, kOpaque, kUnknown };

std::string_view name_of(Liquid liquid);    ///< "yes", "no", "unknown"
std::string_view name_of(LiquidKind kind);  ///< "transparent", "opaque", "unknown"

struct DetectedCup {
  CupCandidate candidate;            ///< the segment and its circle; desk frame
  Eigen::Vector3d center_in_camera;  ///< [m] the circle's centre 45 mm above the desk
  double score_m = 0.0;              ///< how far points lie from the template, or else from the fitted wall
  std::optional<TemplateMatch> match;
  std::optional<double> radius_sigma_m;
  Liquid liquid = Liquid::kUnknown;
  std::optional<double> p_liquid;  ///< probability that there is a liquid, where the method knows one
  std::optional<InteriorHeight> interior;
  std::optional<double> surface_sigma_m;  ///< of its mean height, with what neighbours' errors share
  std::optional<double> bottom_m;         ///< where the empty cup's bottom is taken to be, above the desk
  LiquidKind kind = LiquidKind::kUnknown;
  std::optional<double> fill_m;
  std::optional<double> fill_sigma_m;
  std::string why;                        ///< the decision in words
  std::optional<CupEvidence> evidence{};  ///< what the robust method's decision rests on
};

struct RejectedSegment {
  CupCandidate candidate;                    ///< with the reason
  std::optional<TemplateMatch> match;        ///< when it came so far
  std::optional<InteriorHeight> interior{};  ///< of an open vessel that is no cup
};

struct Detection {
  std::optional<PlaneFit> desk;
  int segments = 0;
  std::vector<DetectedCup> cups;
  std::vector<RejectedSegment> rejected;
  std::string why;  ///< why there is no desk; empty when there is one
  std::vector<StageTime> stages;
};

/// Of the global registration that the paper compares with.
struct RegistrationConfig {
  double normal_radius_m = 0.020;   ///< neighbours of a normal; of 5, 10 and 20 mm the best on nine measured desks
  double feature_radius_m = 0.025;  ///< neighbours of a descriptor: as wide as a cup's radius
  int iterations = 1000;            ///< samples of correspondences that are tried
  double score_max_m = 0.010;       ///< mean distance from the template; as the paper's method's
};

struct DetectorSettings {
  std::optional<DeskPrior> prior;
  std::vector<CupTemplate> templates;
  PaperConfig paper;
  RobustConfig robust{};
  RegistrationConfig registration{};
};

struct Method {
  std::string_view name;
  std::string_view summary;
  Detection (*detect)(const Cloud& cloud, const DetectorSettings& settings);
};

/// Every method, the default first.
std::span<const Method> methods();

/// Throws Error with the names to choose from.
const Method& method_named(std::string_view name);

}  // namespace fathom
