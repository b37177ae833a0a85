#include "terrain/synthetic/synthetic_noise.h"

#include <array>
#include <cmath>

#include "base/math_exact.h"
#include "base/random.h"

namespace belvedere::synthetic {
namespace {

struct Direction {
  float x;
  float y;
};

// Sixteen unit vectors; none is parallel to the lattice, so its axes do not show.
const std::array<Direction, 16>& directions() {
  static const std::array<Direction, 16> table = [] {
    std::array<Direction, 16> t{};
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double angle =
          (static_cast<double>(i) + 0.5) * 0.39269908169872414;  // a sixteenth of a turn
      t[i] = {static_cast<float>(exact::cos(angle)), static_cast<float>(exact::sin(angle))};
    }
    return t;
  }();
  return table;
}

// One multiplication chain for both coordinates: noise is evaluated some ten million times.
inline float corner(const std::array<Direction, 16>& ways, std::uint64_t seed, std::int64_t i,
                    std::int64_t j, float dx, float dy) {
  const std::uint64_t h = mix_bits(seed ^ (static_cast<std::uint64_t>(i) * 0xd6e8feb86659fd93ULL) ^
                                   (static_cast<std::uint64_t>(j) * 0xa0761d6478bd642fULL));
  const Direction d = ways[h >> 60];
  return d.x * dx + d.y * dy;
}

float fade(float t) { return t * t * t * (t * (t * 6.F - 15.F) + 10.F); }

}  // namespace

float gradient_noise(std::uint64_t seed, double x, double y) {
  const double bx = std::floor(x);
  const double by = std::floor(y);
  const auto i = static_cast<std::int64_t>(bx);
  const auto j = static_cast<std::int64_t>(by);
  const auto tx = static_cast<float>(x - bx);
  const auto ty = static_cast<float>(y - by);
  const std::array<Direction, 16>& ways = directions();
  const float a = corner(ways, seed, i, j, tx, ty);
  const float b = corner(ways, seed, i + 1, j, tx - 1.F, ty);
  const float c = corner(ways, seed, i, j + 1, tx, ty - 1.F);
  const float d = corner(ways, seed, i + 1, j + 1, tx - 1.F, ty - 1.F);
  const float u = fade(tx);
  const float top = a + u * (b - a);
  const float bottom = c + u * (d - c);
  return 1.4142135F * (top + fade(ty) * (bottom - top));
}

float fractal_noise(std::uint64_t seed, double x, double y, int octaves, float gain) {
  float sum = 0.F;
  float strength = 1.F;
  float total = 0.F;
  for (int o = 0; o < octaves; ++o) {
    sum += strength * gradient_noise(seed + static_cast<std::uint64_t>(o), x, y);
    total += strength;
    strength *= gain;
    // A rotation of 37° between octaves keeps their lattices from aligning.
    const double turned = 2.0 * (0.7986355 * x - 0.6018150 * y);
    y = 2.0 * (0.6018150 * x + 0.7986355 * y);
    x = turned;
  }
  return sum / total;
}

float ridged_noise(std::uint64_t seed, double x, double y, int octaves, float gain) {
  float sum = 0.F;
  float strength = 1.F;
  float total = 0.F;
  float weight = 1.F;
  for (int o = 0; o < octaves; ++o) {
    const float n = 1.F - std::abs(gradient_noise(seed + static_cast<std::uint64_t>(o), x, y));
    const float ridge = n * n * weight;
    sum += strength * ridge;
    total += strength;
    weight = ridge * 1.6F < 1.F ? ridge * 1.6F : 1.F;
    strength *= gain;
    const double turned = 2.0 * (0.7986355 * x - 0.6018150 * y);
    y = 2.0 * (0.6018150 * x + 0.7986355 * y);
    x = turned;
  }
  return sum / total;
}

}  // namespace belvedere::synthetic
