// The ledger of packs: which was made and opened when. Lines are only ever added, and each holds the hash of all before
// it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fathom::blind {

struct LedgerLine {
  std::string time_utc{}, event{};  ///< "made", "opened"
  std::string pack{}, kind{};
  std::uint64_t seed = 0;
  int sets = 0;
  std::string truth_sha256{}, results_sha256{};  ///< the latter of opened packs
};

/// What a pack is for decides which seeds it may have: [first, last].
struct PackKind {
  std::string name;
  std::uint64_t first_seed, last_seed;
};
const std::vector<PackKind>& pack_kinds();

/// Throws Error when the seed is not one of the kind's.
void require_seed(const std::string& kind, std::uint64_t seed);

/// All lines. Throws Error where a line was changed or taken out.
std::vector<LedgerLine> read_ledger(const std::filesystem::path& path);

/// Adds a line, dated now. Throws Error when a sealed pack of that seed was made before.
void add_to_ledger(const std::filesystem::path& path, LedgerLine line);

/// When a pack with this truth was opened first, if it was.
std::optional<std::string> opened_at(const std::filesystem::path& path, const std::string& truth_sha256);

}  // namespace fathom::blind
