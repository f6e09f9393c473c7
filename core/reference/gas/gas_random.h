#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace slipcheck {

/// Eight xoshiro256++ generators (Blackman and Vigna, ACM Trans. Math. Softw. 47, 36 (2021)) side
/// by side, for vectors of any length: the k-th word of each step is that of the k-th generator.
struct GasRandom {
  static constexpr std::size_t kWidth = 8;
  alignas(64) std::array<std::array<std::uint64_t, kWidth>, 4> state;

  /// `stream` tells generators of one seed apart. The states are words of splitmix64, which no two
  /// streams share: each begins where its number, scrambled, puts it.
  GasRandom(std::uint64_t seed, std::uint64_t stream) {
    std::uint64_t at = scramble(scramble(seed) + stream);
    for (std::size_t k = 0; k < kWidth; ++k)
      for (auto& words : state) words[k] = scramble(at += 0x9e3779b97f4a7c15);
  }

  std::array<std::uint64_t, kWidth> next() {
    auto& [a, b, c, d] = state;
    std::array<std::uint64_t, kWidth> words;
    for (std::size_t k = 0; k < kWidth; ++k) {
      words[k] = std::rotl(a[k] + d[k], 23) + a[k];
      const std::uint64_t t = b[k] << 17;
      c[k] ^= a[k];
      d[k] ^= b[k];
      b[k] ^= c[k];
      a[k] ^= d[k];
      c[k] ^= t;
      d[k] = std::rotl(d[k], 45);
    }
    return words;
  }

  /// The finaliser of splitmix64.
  static std::uint64_t scramble(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
};

}  // namespace slipcheck
