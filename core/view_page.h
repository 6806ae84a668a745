// The page that `fathom view` makes of a folder's results, and leaves there.
#pragma once

#include <filesystem>
#include <string>

#include "core/files.h"

namespace fathom {

inline constexpr const char* kViewPage = "view.html";
inline constexpr const char* kViewTitle = "Fathom: view of ";  ///< how its title begins

/// For who writes other results into the folder.
inline void remove_view_page(const std::filesystem::path& folder) {
  remove_if_ours(folder / kViewPage, std::string("<title>") + kViewTitle);
}

}  // namespace fathom
