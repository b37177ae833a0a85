#pragma once

#include <vector>

namespace belvedere {

// The row loops of generalize(): plain loops over x without branches, compiled once for each vector
// width (Highway's dispatch) so that the compiler vectorizes them. Elementwise IEEE arithmetic
// without contraction gives the same bits at each width. "Padded" rows have that many values before
// and after the row.

// Plan curvature by the quadric that Evans (1980) and Young (1978) fit to 3 × 3 cells: p, q are its
// slopes to east and north, r, s, t its second derivatives (xx, xy, yy), N = q²r - 2pqs + p²t, g² =
// p² + q².
struct BreakLineScale {
  bool plan = false;      // -N/g³, else -N/g²
  float inverse_x = 1.F;  // 1 / width of a cell, 1/m
  float inverse_y = 1.F;  // 1 / height of a cell
  float scale_m = 1.F;    // mean cell / full curvature
};
// Curvature · scale_m of a row from three rows of altitudes, padded by 1. Convex ground is
// positive; a cone has -N/g³ = 1 / radius of its contour. Ground flatter than 1 mm in 1 km has no
// direction and gets 0; for -N/g³ the limit is 1 m in 1 km.
void plan_curvature_row(const float* north, const float* here, const float* south, int width,
                        const BreakLineScale& scale, float* out);
// c of the row before its blur: min(|curvature| · scale_m, 1).
void break_line_row(const float* north, const float* here, const float* south, int width,
                    const BreakLineScale& scale, float* out);

// Sum of taps[k] · padded[x + k - radius]; taps has 2 radius + 1 values.
void blur_across_row(const float* padded, const std::vector<float>& taps, int width, float* out);
// Sum of taps[k] · rows[k][x].
void blur_down_row(const float* const* rows, const std::vector<float>& taps, int width, float* out);
// x^exponent for 0 ≤ x ≤ 1, in place, exponent > 0; error below 1e-5. Exactly 0 at 0 and 1 at 1.
void power_row(float* values, int width, float exponent);

// Binomial mean of 3 × 3 cells, 1 2 1 across and down; rows padded by 1.
void binomial_row(const float* north, const float* here, const float* south, int width, float* out);
// Weight of the ridge set against the valley set in a band, by the sign of the band's profile
// curvature, which is opposite to that of P = p²r + 2pqs + q²t: 1 where P < 0 (convex), 0 where P >
// 0, intermediate only where a curvature |P| / g² is below .02 |L| per cell². The band is that of
// expand_evenly_row: expand() fills even and odd cells with different taps, so L alternates by a
// tenth of its curvature from cell to cell, and so would the sign. On nearly level parts of the
// band there is no fall line. There the band's binomial mean is used by the mean of its P over 3 ×
// 3 cells, P + 2/3 (cell_x² (H³)_xx + cell_y² (H³)_yy), which has a sign even where P is 0, along
// the bottom of a valley and on a ridge. The weight is blended from that to the cell's own in
// proportion to the curvature. Three rows of the band and three of its binomial mean, padded by 1.
void convex_share_row(const float* const band[3], const float* const mean[3], int width,
                      float inverse_x, float inverse_y, float* out);

// Inputs of a cell's weight. Null pointers: share 1, no break lines, mask 1, nothing kept,
// printable.
struct WeightRows {
  const float* share = nullptr;
  const float* break_line = nullptr;  // c
  const float* convex =
      nullptr;  // weight of the ridge set against the valley set; null: they are equal
  const unsigned char* keep = nullptr;  // != 0: weight 1
  const float* mask = nullptr;
  const float* amplify = nullptr;  // mask of the part above 1
  const float* ground_m_per_pixel = nullptr;
};
struct WeightSet {
  float global = 1.F;
  float ridges = 0.F;
  float valleys = 0.F;
};
struct BandWeights {
  WeightSet near;
  WeightSet far;
  float printable_m_per_pixel = 0.F;  // wavelength / print_pixels
};
// out += (w - 1) · (level - smooth).
void weigh_row(const WeightRows& rows, const BandWeights& weights, const float* level,
               const float* smooth, int width, float* gain, float* out);

// out[x] = a[x] + b[x], and a[x] - b[x].
void add_row(const float* a, const float* b, int width, float* out);
void subtract_row(const float* a, const float* b, int width, float* out);

}  // namespace belvedere
