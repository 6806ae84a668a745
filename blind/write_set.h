// A set as a laboratory hands it over: rig.json, frames.csv, clouds. What is true stands elsewhere.
#pragma once

#include <filesystem>

#include "blind/draw.h"
#include "blind/follow_up.h"

namespace fathom::blind {

/// Writes the measurement directory; it appears whole or not at all. Returns the number of frames.
int write_set(const SetTruth& truth, const std::filesystem::path& folder);

/// The same laboratory another day: a folder of one later session. What is hidden, the rig's errors and dust are the
/// set's; the session's setting up, fills, places and noise are new.
int write_follow_up(const SetTruth& truth, const FollowUp& wanted, const std::filesystem::path& folder);

/// The same without effects, errors, dust and noise: what the generator's physics alone makes of the full design. For
/// comparison with the analyser's physics; heights are in frames.csv.
int write_exact_set(const std::filesystem::path& folder);

}  // namespace fathom::blind
