// What a detector is given and what it finds, and the table of methods.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "detector/cloud.h"
#include "detector/icp.h"
#include "detector/paper_config.h"
#include "detector/plane.h"

namespace fathom {

/// Whether what fills a cup is seen through (its bottom reads raised) or seen itself.
enum class LiquidKind { kTransparent, kOpaque, kUnknown };

std::string_view name_of(Liquid liquid);    ///< "yes", "no", "unknown"
std::string_view name_of(LiquidKind kind);  ///< "transparent", "opaque", "unknown"

struct DetectedCup {
  Candidate candidate;               ///< the segment and its circle; desk frame
  Eigen::Vector3d center_in_camera;  ///< [m] the circle's centre 45 mm above the desk
  TemplateMatch match;
  Liquid liquid = Liquid::kUnknown;
  std::optional<InteriorHeight> interior;
  LiquidKind kind = LiquidKind::kUnknown;
  std::optional<double> fill_m;
  std::optional<double> fill_sigma_m;
  std::string why;  ///< the decision in words
};

struct RejectedSegment {
  Candidate candidate;                 ///< with the reason
  std::optional<TemplateMatch> match;  ///< when it came so far
};

struct Detection {
  std::optional<PlaneFit> desk;
  int segments = 0;
  std::vector<DetectedCup> cups;
  std::vector<RejectedSegment> rejected;
  std::string why;  ///< why there is no desk; empty when there is one
};

struct DetectorSettings {
  std::optional<DeskPrior> prior;
  std::vector<CupTemplate> templates;
  PaperConfig paper;
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
