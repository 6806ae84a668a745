// Random desks as the paper's experiments need them: the same desks, searched by several methods.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "sim/scene/clutter.h"
#include "trials/trial.h"

namespace fathom {

/// A clutter file that comes with the program, changed by a JSON merge patch (RFC 7386).
ClutterSpec changed_clutter(const std::string& file, const std::string& patch);

/// What each of the methods finds, in their order, on desks 0 to `desks` − 1. Steps `progress` after each desk.
std::vector<std::vector<TrialResult>> search_desks(const ClutterSpec& clutter,
                                                   std::span<const std::string_view> methods, int desks,
                                                   std::uint64_t seed, Progress& progress);

/// "15/20 = 75 % (53–89 %)", with Wilson's 95 % interval; "–" of nothing.
std::string share_text(int hits, int all);

}  // namespace fathom
