#include "terrain/synthetic/synthetic_plan.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "terrain/synthetic/synthetic_noise.h"

namespace belvedere::synthetic {

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
