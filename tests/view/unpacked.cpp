#include "tests/view/unpacked.h"

#include <gtest/gtest.h>
#include <zlib.h>

namespace fathom {

std::string inflated(const Json& block) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : block["deflate"].get<std::string>()) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(kDigits.find(c));
    if ((held += 6) >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 255U);
  }
  std::string values(4'000'000, '\0');
  uLongf size = values.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(values.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                       static_cast<uLong>(bytes.size())),
            Z_OK);
  values.resize(size);
  return values;
}

}  // namespace fathom
