// Base64 (RFC 4648) of bytes, by OpenSSL: pictures in pages.
#pragma once

#include <string>
#include <string_view>

namespace fathom {

std::string base64(std::string_view bytes);

}  // namespace fathom
