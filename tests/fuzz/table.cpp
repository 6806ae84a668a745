// Tables of measurements: every cell is asked for as a number, and the table is written again.
#include "core/table.h"

#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fathom::fuzz_file(data, size, ".csv", [](const std::filesystem::path& path) {
    const fathom::Table table = fathom::read_table(path);
    static_cast<void>(table.csv());
    for (std::size_t row = 0; row < table.rows(); ++row)
      for (const std::string& column : table.columns()) table.number_if_any(row, column);
  });
}
