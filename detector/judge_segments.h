// What the paper's method and registration have in common: each segment on the desk is placed against the templates by
// itself, and a cup's content is read from the height inside it.
#pragma once

#include <functional>
#include <string>
#include <variant>

#include "detector/desk_view.h"
#include "detector/detector.h"

namespace fathom {

/// A segment that is a template's cup; its candidate has a circle.
struct PlacedCup {
  CupCandidate candidate;
  TemplateMatch match;
};

using Placement = std::variant<PlacedCup, RejectedSegment>;

/// Where `place` finds a template's cup, its centre, the height inside and whether that is a liquid; `why` says that it
/// `matches` the template, in those words.
Detection judge_segments(const Cloud& cloud, const DetectorSettings& settings, std::string_view matches,
                         const std::function<Placement(CupCandidate)>& place);

}  // namespace fathom
