#include "bench/blind/sha256.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace fathom::blind {
namespace {

using Words = std::array<std::uint32_t, 8>;

/// First 32 bits of the fractions of the primes' roots: square roots of the first 8, cube roots of the first 64.
template <std::size_t N>
std::array<std::uint32_t, N> fractions_of_prime_roots(long double (*root)(long double)) {
  std::array<std::uint32_t, N> result{};
  int prime = 1;
  for (std::uint32_t& word : result) {
    bool is_prime = false;
    while (!is_prime) {
      ++prime;
      is_prime = true;
      for (int d = 2; d * d <= prime; ++d) is_prime = is_prime && prime % d != 0;
    }
    const long double value = root(static_cast<long double>(prime));
    word = static_cast<std::uint32_t>((value - std::floor(value)) * 4294967296.0L);
  }
  return result;
}

void take_block(const std::uint8_t* block, const std::array<std::uint32_t, 64>& k, Words& hash) {
  std::array<std::uint32_t, 64> w{};
  for (int i = 0; i < 16; ++i)
    w[i] = std::uint32_t{block[4 * i]} << 24 | std::uint32_t{block[4 * i + 1]} << 16 |
           std::uint32_t{block[4 * i + 2]} << 8 | std::uint32_t{block[4 * i + 3]};
  for (int i = 16; i < 64; ++i) {
    const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
    const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = hash;
  for (int i = 0; i < 64; ++i) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + k[i] + w[i];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const Words add{a, b, c, d, e, f, g, h};
  for (int i = 0; i < 8; ++i) hash[i] += add[i];
}

}  // namespace

std::string sha256(std::string_view bytes) {
  static const auto k = fractions_of_prime_roots<64>([](long double x) { return std::cbrt(x); });
  Words hash = fractions_of_prime_roots<8>([](long double x) { return std::sqrt(x); });
  std::string padded(bytes);
  padded += static_cast<char>(0x80);
  padded.resize((padded.size() + 8 + 63) / 64 * 64, '\0');
  const std::uint64_t bits = std::uint64_t{bytes.size()} * 8;
  for (int i = 0; i < 8; ++i) padded[padded.size() - 1 - i] = static_cast<char>(bits >> (8 * i));
  for (std::size_t at = 0; at < padded.size(); at += 64)
    take_block(reinterpret_cast<const std::uint8_t*>(padded.data()) + at, k, hash);
  std::string text;
  for (const std::uint32_t word : hash) text += fmt::format("{:08x}", word);
  return text;
}

}  // namespace fathom::blind
