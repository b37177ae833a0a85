#pragma once

#include <cstdint>

namespace belvedere {

// Counter-based random numbers: a value is a pure function of its key, so it does not depend on
// threads, tiles or order. Mixing is the finalizer of MurmurHash3 (64 bit), applied to every word
// of the key.
constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z ^= z >> 33;
  z *= 0xff51afd7ed558ccdULL;
  z ^= z >> 33;
  z *= 0xc4ceb9fe1a85ec53ULL;
  z ^= z >> 33;
  return z;
}

// Key: the seed of a stream (random_streams.h), two integer coordinates (pixel, cell or lattice
// point), draw number.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::int64_t x, std::int64_t y,
                                    std::uint64_t draw = 0) {
  std::uint64_t h = mix_bits(seed + 0x9e3779b97f4a7c15ULL);
  h = mix_bits(h ^ (static_cast<std::uint64_t>(x) * 0xd6e8feb86659fd93ULL));
  h = mix_bits(h ^ (static_cast<std::uint64_t>(y) * 0xa0761d6478bd642fULL));
  return mix_bits(h ^ (draw * 0xe7037ed1a0b428dbULL));
}

// Uniform in [0, 1): 53 bits, exact in double, so the same on every machine.
constexpr double random_uniform(std::uint64_t seed, std::int64_t x, std::int64_t y,
                                std::uint64_t draw = 0) {
  return static_cast<double>(random_bits(seed, x, y, draw) >> 11) * 0x1.0p-53;
}

// Integer in [0, count), count > 0; the bias of the multiply-shift is below 2^-32.
constexpr std::uint32_t random_index(std::uint32_t count, std::uint64_t seed, std::int64_t x,
                                     std::int64_t y, std::uint64_t draw = 0) {
  return static_cast<std::uint32_t>(((random_bits(seed, x, y, draw) >> 32) * count) >> 32);
}

// Roughly normal, mean 0, deviation 1, bounded to ±3.46: the sum of four uniforms of 16 bits each
// (Irwin-Hall), scaled by sqrt(3). It uses no transcendental function, so it is bit-exact
// everywhere.
constexpr double random_normal(std::uint64_t seed, std::int64_t x, std::int64_t y,
                               std::uint64_t draw = 0) {
  const std::uint64_t b = random_bits(seed, x, y, draw);
  const double sum =
      static_cast<double>((b & 0xffff) + ((b >> 16) & 0xffff) + ((b >> 32) & 0xffff) + (b >> 48));
  return (sum * (1.0 / 65535.0) - 2.0) * 1.7320508075688772;
}

}  // namespace belvedere
