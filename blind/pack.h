// A pack on disk: PACK/pack.json tells what everybody may know, and of each set which effect its analyser must lack, if
// any; PACK/sets/NNNN are measurement directories. The truth is one file elsewhere, whose hash pack.json holds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "blind/draw.h"

namespace fathom::blind {

struct Pack {
  std::string name{}, kind{};
  std::uint64_t seed = 0;
  std::string truth_sha256{};
  std::vector<SetTruth> sets{};
};

/// Draws all sets (on all threads) and writes truth and pack.json.
void seal_pack(const std::string& kind, std::uint64_t seed, int sets, const std::filesystem::path& folder,
               const std::filesystem::path& truth, const std::filesystem::path& ledger);

/// Throws Error when the truth is not the one that pack.json names.
Pack open_pack(const std::filesystem::path& folder, const std::filesystem::path& truth);

std::filesystem::path set_folder(const std::filesystem::path& pack, int number);

}  // namespace fathom::blind
