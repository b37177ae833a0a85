#include "terrain/generalize/generalize_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

// This file is compiled once for each vector width by Highway.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/generalize/generalize_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace belvedere::rows {
namespace HWY_NAMESPACE {

// First and second derivatives of the quadric through 3 × 3 cells (Evans 1980, Young 1978). It uses
// only differences of neighbours, which float holds exactly or to their own precision: at 5000 m no
// precision is lost.
struct Quadric {
  float p, q, r, s, t;
};

HWY_INLINE Quadric fit(const float* a, const float* b, const float* c, int x, float ix, float iy) {
  const float a_across = a[x + 1] - a[x - 1];
  const float b_across = b[x + 1] - b[x - 1];
  const float c_across = c[x + 1] - c[x - 1];
  const float west = a[x - 1] - c[x - 1];
  const float centre = a[x] - c[x];
  const float east = a[x + 1] - c[x + 1];
  const float a_bend = (a[x + 1] - a[x]) - (a[x] - a[x - 1]);
  const float b_bend = (b[x + 1] - b[x]) - (b[x] - b[x - 1]);
  const float c_bend = (c[x + 1] - c[x]) - (c[x] - c[x - 1]);
  const float west_bend = (a[x - 1] - b[x - 1]) - (b[x - 1] - c[x - 1]);
  const float middle_bend = (a[x] - b[x]) - (b[x] - c[x]);
  const float east_bend = (a[x + 1] - b[x + 1]) - (b[x + 1] - c[x + 1]);
  constexpr float sixth = 1.F / 6.F;
  constexpr float third = 1.F / 3.F;
  return {(a_across + b_across + c_across) * (sixth * ix), (west + centre + east) * (sixth * iy),
          (a_bend + b_bend + c_bend) * (third * ix * ix), (a_across - c_across) * (0.25F * ix * iy),
          (west_bend + middle_bend + east_bend) * (third * iy * iy)};
}

// Curvatures of a row, in the form required by `keep`.
template <class Keep>
HWY_INLINE void each_plan_curvature(const float* a, const float* b, const float* c, int width,
                                    const BreakLineScale& scale, float* HWY_RESTRICT out,
                                    Keep&& keep) {
  const float ix = scale.inverse_x;
  const float iy = scale.inverse_y;
  const float gain = scale.scale_m;
  // Ground flatter than 1 mm in 1 km has no direction. For N/g³ the limit is 1 m in 1 km, because
  // of the rounding of altitudes.
  if (scale.plan) {
    for (int x = 0; x < width; ++x) {
      const Quadric z = fit(a, b, c, x, ix, iy);
      const float n = z.q * z.q * z.r - 2.F * z.p * z.q * z.s + z.p * z.p * z.t;
      const float g2 = z.p * z.p + z.q * z.q + 1e-6F;
      out[x] = keep(-n * gain / (g2 * std::sqrt(g2)));
    }
  } else {
    for (int x = 0; x < width; ++x) {
      const Quadric z = fit(a, b, c, x, ix, iy);
      const float n = z.q * z.q * z.r - 2.F * z.p * z.q * z.s + z.p * z.p * z.t;
      out[x] = keep(-n * gain / (z.p * z.p + z.q * z.q + 1e-12F));
    }
  }
}

void PlanCurvatureRow(const float* a, const float* b, const float* c, int width,
                      const BreakLineScale& scale, float* HWY_RESTRICT out) {
  each_plan_curvature(a, b, c, width, scale, out, [](float k) { return k; });
}

void BreakLineRow(const float* a, const float* b, const float* c, int width,
                  const BreakLineScale& scale, float* HWY_RESTRICT out) {
  each_plan_curvature(a, b, c, width, scale, out, [](float k) {
    const float size = std::abs(k);
    return size < 1.F ? size : 1.F;
  });
}

void BlurAcrossRow(const float* padded, const float* taps, int radius, int width,
                   float* HWY_RESTRICT out) {
  // The kernel is symmetric.
  for (int x = 0; x < width; ++x) out[x] = taps[radius] * padded[x];
  for (int k = 1; k <= radius; ++k) {
    const float tap = taps[radius + k];
    const float* before = padded - k;
    const float* after = padded + k;
    for (int x = 0; x < width; ++x) out[x] += tap * (before[x] + after[x]);
  }
}

void BlurDownRow(const float* const* rows, const float* taps, int radius, int width,
                 float* HWY_RESTRICT out) {
  const float* centre = rows[radius];
  for (int x = 0; x < width; ++x) out[x] = taps[radius] * centre[x];
  for (int k = 1; k <= radius; ++k) {
    const float tap = taps[radius + k];
    const float* before = rows[radius - k];
    const float* after = rows[radius + k];
    for (int x = 0; x < width; ++x) out[x] += tap * (before[x] + after[x]);
  }
}

void PowerRow(float* HWY_RESTRICT values, int width, float exponent) {
  for (int x = 0; x < width; ++x) {
    const float v = std::min(std::max(values[x], 0.F), 1.F);
    // log2 of the mantissa m by the series of artanh in (m - 1) / (m + 1), which is 0 at m = 1.
    const std::int32_t bits = std::bit_cast<std::int32_t>(v);
    const float m = std::bit_cast<float>((bits & 0x007fffff) | 0x3f800000);
    const float s = (m - 1.F) / (m + 1.F);
    const float s2 = s * s;
    const float series =
        2.885390082F * s *
        (1.F + s2 * (1.F / 3.F + s2 * (1.F / 5.F + s2 * (1.F / 7.F + s2 * (1.F / 9.F)))));
    const float log2 = static_cast<float>((bits >> 23) - 127) + series;
    // 2^y = 2^whole · e^(part ln 2), part within ±.5.
    const float y = std::max(exponent * log2, -126.F);
    const std::int32_t whole = static_cast<std::int32_t>(y - 0.5F);
    const float f = 0.693147181F * (y - static_cast<float>(whole));
    const float part =
        1.F + f * (1.F + f * (0.5F + f * (1.F / 6.F + f * (1.F / 24.F + f * (1.F / 120.F +
                                                                             f * (1.F / 720.F))))));
    const float power = part * std::bit_cast<float>((whole + 127) << 23);
    values[x] = v > 1e-37F ? power : 0.F;
  }
}

void BinomialRow(const float* a, const float* b, const float* c, int width,
                 float* HWY_RESTRICT out) {
  for (int x = 0; x < width; ++x) {
    const float west = (a[x - 1] + c[x - 1]) + 2.F * b[x - 1];
    const float centre = (a[x] + c[x]) + 2.F * b[x];
    const float east = (a[x + 1] + c[x + 1]) + 2.F * b[x + 1];
    out[x] = 0.0625F * ((west + east) + 2.F * centre);
  }
}

void ConvexShareRow(const float* const* band, const float* const* mean, int width, float ix,
                    float iy, float* HWY_RESTRICT out) {
  // P at d from the cell is (g + H d)ᵀ H (g + H d) on the quadric, g its gradient and H its second
  // derivatives. Over the nine cells, whose offsets have mean 0 and variance 2/3 of a cell along x
  // and along y, the term linear in d vanishes and the mean is exactly P + 2/3 (cell_x² (H³)_xx +
  // cell_y² (H³)_yy). Lengths are in cells (the geometric mean), so that P is in m³ and no float
  // underflows.
  const float nx = std::sqrt(ix / iy);
  const float ny = std::sqrt(iy / ix);
  const float spread_x = 2.F / 3.F * ny * ny;
  const float spread_y = 2.F / 3.F * nx * nx;
  for (int x = 0; x < width; ++x) {
    const Quadric z = fit(band[0], band[1], band[2], x, nx, ny);
    const Quadric m = fit(mean[0], mean[1], mean[2], x, nx, ny);
    const float own = (z.p * z.p * z.r + z.q * z.q * z.t) + 2.F * z.p * z.q * z.s;
    const float m2 = m.s * m.s;
    const float bend_x = m.r * (m.r * m.r + 2.F * m2) + m2 * m.t;
    const float bend_y = m.t * (m.t * m.t + 2.F * m2) + m2 * m.r;
    const float around = ((m.p * m.p * m.r + m.q * m.q * m.t) + 2.F * m.p * m.q * m.s) +
                         (spread_x * bend_x + spread_y * bend_y);
    // Almost level, compared with a tenth of its curvature per cell, the band has no direction. The
    // smallest normal float avoids 0/0.
    const float fall =
        (z.p * z.p + z.q * z.q) + 0.01F * ((z.r * z.r + z.t * z.t) + 2.F * z.s * z.s);
    const float clear = std::abs(own) / (0.02F * fall * std::abs(band[1][x]) + 1.18e-38F);
    const float rules = clear < 1.F ? clear : 1.F;
    const float by_own = own < 0.F ? 1.F : 0.F;
    // The transition takes a twentieth of the form, so that the last bit cannot flip the result.
    const float size =
        ((m.p * m.p + m.q * m.q) + 2.F / 3.F * ((m.r * m.r + m.t * m.t) + 2.F * m2)) *
        std::abs(mean[1][x]);
    const float side = 0.5F - around / (0.1F * size + 1.18e-38F);
    const float by_mean = side < 0.F ? 0.F : side < 1.F ? side : 1.F;
    out[x] = by_mean + rules * (by_own - by_mean);
  }
}

HWY_INLINE float unit(float v) {
  const float max = v < 1.F ? v : 1.F;
  return max > 0.F ? max : 0.F;
}

void WeighRow(const WeightRows& in, const BandWeights& w, const float* level, const float* smooth,
              int width, float* HWY_RESTRICT gain, float* HWY_RESTRICT out) {
  const float* share = in.share;
  if (share != nullptr) {
    for (int x = 0; x < width; ++x) {
      const float near = unit(share[x]);
      gain[x] = near * w.near.global + (1.F - near) * w.far.global;
    }
  } else {
    for (int x = 0; x < width; ++x) gain[x] = w.near.global;
  }
  if (in.break_line != nullptr) {
    const float* c = in.break_line;
    const float* convex = in.convex;
    const WeightSet n = w.near;
    const WeightSet f = w.far;
    if (convex == nullptr && share == nullptr) {
      for (int x = 0; x < width; ++x) gain[x] += n.ridges * c[x];
    } else if (convex == nullptr) {
      for (int x = 0; x < width; ++x) {
        const float near = unit(share[x]);
        gain[x] += (near * n.ridges + (1.F - near) * f.ridges) * c[x];
      }
    } else if (share == nullptr) {
      for (int x = 0; x < width; ++x)
        gain[x] += (convex[x] * n.ridges + (1.F - convex[x]) * n.valleys) * c[x];
    } else {
      for (int x = 0; x < width; ++x) {
        const float near = unit(share[x]);
        const float ridges = near * n.ridges + (1.F - near) * f.ridges;
        const float valleys = near * n.valleys + (1.F - near) * f.valleys;
        gain[x] += (convex[x] * ridges + (1.F - convex[x]) * valleys) * c[x];
      }
    }
  }
  if (in.ground_m_per_pixel != nullptr) {
    const float* ground = in.ground_m_per_pixel;
    const float limit = w.printable_m_per_pixel;
    for (int x = 0; x < width; ++x) {
      // Half the limit of the wavelength: 0; the limit: 1.
      const float t = unit(2.F * limit / std::max(ground[x], 1e-6F) - 1.F);
      gain[x] *= t * t * (3.F - 2.F * t);
    }
  }
  for (int x = 0; x < width; ++x) gain[x] -= 1.F;
  if (in.amplify != nullptr) {
    const float* m = in.amplify;
    for (int x = 0; x < width; ++x) {
      const float more = gain[x] * unit(m[x]);
      gain[x] = gain[x] > 0.F ? more : gain[x];
    }
  }
  if (in.keep != nullptr) {
    const unsigned char* k = in.keep;
    for (int x = 0; x < width; ++x) gain[x] *= k[x] == 0 ? 1.F : 0.F;
  }
  if (in.mask != nullptr) {
    const float* m = in.mask;
    for (int x = 0; x < width; ++x) gain[x] *= unit(m[x]);
  }
  for (int x = 0; x < width; ++x) out[x] += gain[x] * (level[x] - smooth[x]);
}

void AddRow(const float* a, const float* b, int width, float* HWY_RESTRICT out) {
  for (int x = 0; x < width; ++x) out[x] = a[x] + b[x];
}

void SubtractRow(const float* a, const float* b, int width, float* HWY_RESTRICT out) {
  for (int x = 0; x < width; ++x) out[x] = a[x] - b[x];
}

}  // namespace HWY_NAMESPACE
}  // namespace belvedere::rows
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace belvedere {
namespace rows {
HWY_EXPORT(PlanCurvatureRow);
HWY_EXPORT(BreakLineRow);
HWY_EXPORT(BlurAcrossRow);
HWY_EXPORT(BlurDownRow);
HWY_EXPORT(PowerRow);
HWY_EXPORT(BinomialRow);
HWY_EXPORT(ConvexShareRow);
HWY_EXPORT(WeighRow);
HWY_EXPORT(AddRow);
HWY_EXPORT(SubtractRow);
}  // namespace rows

void plan_curvature_row(const float* north, const float* here, const float* south, int width,
                        const BreakLineScale& scale, float* out) {
  HWY_DYNAMIC_DISPATCH(rows::PlanCurvatureRow)(north, here, south, width, scale, out);
}

void break_line_row(const float* north, const float* here, const float* south, int width,
                    const BreakLineScale& scale, float* out) {
  HWY_DYNAMIC_DISPATCH(rows::BreakLineRow)(north, here, south, width, scale, out);
}

void blur_across_row(const float* padded, const std::vector<float>& taps, int width, float* out) {
  HWY_DYNAMIC_DISPATCH(rows::BlurAcrossRow)
  (padded, taps.data(), static_cast<int>(taps.size()) / 2, width, out);
}

void blur_down_row(const float* const* rows, const std::vector<float>& taps, int width,
                   float* out) {
  HWY_DYNAMIC_DISPATCH(rows::BlurDownRow)
  (rows, taps.data(), static_cast<int>(taps.size()) / 2, width, out);
}

void power_row(float* values, int width, float exponent) {
  HWY_DYNAMIC_DISPATCH(rows::PowerRow)(values, width, exponent);
}

void binomial_row(const float* north, const float* here, const float* south, int width,
                  float* out) {
  HWY_DYNAMIC_DISPATCH(rows::BinomialRow)(north, here, south, width, out);
}

void convex_share_row(const float* const band[3], const float* const mean[3], int width,
                      float inverse_x, float inverse_y, float* out) {
  HWY_DYNAMIC_DISPATCH(rows::ConvexShareRow)(band, mean, width, inverse_x, inverse_y, out);
}

void weigh_row(const WeightRows& in, const BandWeights& weights, const float* level,
               const float* smooth, int width, float* gain, float* out) {
  HWY_DYNAMIC_DISPATCH(rows::WeighRow)(in, weights, level, smooth, width, gain, out);
}

void add_row(const float* a, const float* b, int width, float* out) {
  HWY_DYNAMIC_DISPATCH(rows::AddRow)(a, b, width, out);
}

void subtract_row(const float* a, const float* b, int width, float* out) {
  HWY_DYNAMIC_DISPATCH(rows::SubtractRow)(a, b, width, out);
}

}  // namespace belvedere
#endif
