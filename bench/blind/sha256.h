// SHA-256 (FIPS 180-4), by which a truth is sealed before anybody has answered.
#pragma once

#include <string>
#include <string_view>

namespace fathom::blind {

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace fathom::blind
