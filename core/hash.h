// SHA-256 (FIPS 180-4) of bytes and files, by OpenSSL.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace fathom {

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

/// Of a file's content, read piece by piece. Throws Error when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace fathom
