#include "blind/ledger.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/table.h"

namespace fathom::blind {
namespace {

const std::vector<std::string> kColumns{"time_utc", "event",        "pack",           "kind",           "seed",
                                        "sets",     "truth_sha256", "results_sha256", "previous_sha256"};

std::string now_utc() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

/// Hash of the file as it stood before each of its lines.
void check_chain(const Table& table) {
  Table before(kColumns);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "previous_sha256") != sha256(before.csv()))
      table.fail(row, "previous_sha256", "does not fit the lines above: the ledger was changed");
    std::vector<std::string> cells;
    for (const std::string& column : kColumns) cells.push_back(table.text(row, column));
    before.add(std::move(cells));
  }
}

Table ledger_table(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return Table(kColumns, path.string());
  Table table = read_table(path);
  check_chain(table);
  return table;
}

}  // namespace

const std::vector<PackKind>& pack_kinds() {
  static const std::vector<PackKind> kinds{
      {"development", 1, 9'999}, {"validation", 10'000, 19'999}, {"sealed", 20'000, 0xffff'ffff'ffff}};
  return kinds;
}

void require_seed(const std::string& kind, std::uint64_t seed) {
  std::vector<std::string> names;
  for (const PackKind& known : pack_kinds()) {
    names.push_back(known.name);
    if (known.name != kind) continue;
    if (seed < known.first_seed || seed > known.last_seed)
      throw Error("--seed", fmt::format("of a {} pack must be from {} to {}, got {}", kind, known.first_seed,
                                        known.last_seed, seed));
    return;
  }
  throw Error("--kind", unknown_name("kind", kind, names));
}

std::vector<LedgerLine> read_ledger(const std::filesystem::path& path) {
  const Table table = ledger_table(path);
  std::vector<LedgerLine> lines;
  for (std::size_t row = 0; row < table.rows(); ++row)
    lines.push_back({table.text(row, "time_utc"), table.text(row, "event"), table.text(row, "pack"),
                     table.text(row, "kind"), static_cast<std::uint64_t>(table.number(row, "seed")),
                     static_cast<int>(table.number(row, "sets")), table.text(row, "truth_sha256"),
                     table.text(row, "results_sha256")});
  return lines;
}

void add_to_ledger(const std::filesystem::path& path, LedgerLine line) {
  Table table = ledger_table(path);
  for (const LedgerLine& earlier : read_ledger(path))
    if (line.event == "made" && line.kind == "sealed" && earlier.kind == "sealed" && earlier.seed == line.seed)
      throw Error(path.string(), fmt::format("a sealed pack of seed {} was made on {}: take another seed", line.seed,
                                             earlier.time_utc));
  const std::string before = sha256(table.csv());
  table.add({now_utc(), line.event, line.pack, line.kind, fmt::format("{}", line.seed), fmt::format("{}", line.sets),
             line.truth_sha256, line.results_sha256, before});
  write_table(path, table);
}

std::optional<std::string> opened_at(const std::filesystem::path& path, const std::string& truth_sha256) {
  for (const LedgerLine& line : read_ledger(path))
    if (line.event == "opened" && line.truth_sha256 == truth_sha256) return line.time_utc;
  return std::nullopt;
}

}  // namespace fathom::blind
