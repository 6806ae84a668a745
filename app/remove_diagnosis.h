// Makes room for a new diagnosis where an older one lies.
#pragma once

#include <filesystem>

namespace fathom {

/// Removes what an older diagnosis left, report.json first: a folder with it holds one whole diagnosis. Files of
/// others stay, by whatever names, and model.json, which is written again and may be what the new one goes on from.
void remove_diagnosis(const std::filesystem::path& folder);

}  // namespace fathom
