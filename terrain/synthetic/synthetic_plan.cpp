#include "terrain/synthetic/synthetic_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"

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

Plan::Plan(double height_m, double unit_m, std::uint64_t seed)
    : height_m_(height_m), unit_m_(unit_m), seed_(mix_bits(seed)) {
  valleys_ = std::max(1, static_cast<int>(std::lround(height_m / (38000.0 * unit_m))));
}

bool Plan::flows_east(int valley) const {
  return (draw_bits(seed_, valley, 0, TerrainDraw::valley_direction) & 1) != 0;
}

double Plan::valley_y(int valley, double x) const {
  const double centre =
      (valley + 0.42 + 0.16 * draw_uniform(seed_, valley, 0, TerrainDraw::valley_place)) *
      height_m_ / valleys_;
  const double u = x / unit_m_;
  return centre +
         unit_m_ * (4200.0 * gradient_noise(noise_seed(seed_, TerrainNoise::valley_bends),
                                            u / 17000.0, valley * 7.3) +
                    1300.0 * gradient_noise(noise_seed(seed_, TerrainNoise::valley_wavering),
                                            u / 5200.0, valley * 3.1));
}

float Plan::uplift(double x, double y) const {
  const double u = x / unit_m_;
  const double v = y / unit_m_;
  const double wu = u + 3500.0 * fractal_noise(noise_seed(seed_, TerrainNoise::range_bends_east),
                                               u / 11000.0, v / 11000.0, 3);
  const double wv = v + 3500.0 * fractal_noise(noise_seed(seed_, TerrainNoise::range_bends_south),
                                               u / 11000.0, v / 11000.0, 3);
  const float massif = 1.0F + 0.55F * fractal_noise(noise_seed(seed_, TerrainNoise::massifs),
                                                    wu / 21000.0, wv / 21000.0, 2);
  const float range =
      ridged_noise(noise_seed(seed_, TerrainNoise::ranges), wu / 19000.0, wv / 10500.0, 4);
  float rise = std::max(0.12F, massif) * (0.50F + 0.80F * range);
  for (int k = 0; k < valleys_; ++k) {
    const auto off = static_cast<float>((y - valley_y(k, x)) / unit_m_);
    const float near = std::abs(off) *
                       (1.F + 0.35F * gradient_noise(noise_seed(seed_, TerrainNoise::valley_widths),
                                                     u / 6000.0, v / 6000.0));
    rise *= 0.10F + 0.90F * smoothstep(500.F, 3200.F, near);
  }
  return rise;
}

float Plan::softness(double x, double y) const {
  const double u = x / unit_m_;
  const double v = y / unit_m_;
  return exact::exp2(
      1.3F * fractal_noise(noise_seed(seed_, TerrainNoise::soft_rock), u / 3600.0, v / 3600.0, 2) +
      1.1F * fractal_noise(noise_seed(seed_, TerrainNoise::soft_patches), u / 700.0, v / 700.0, 3));
}

}  // namespace belvedere::synthetic
