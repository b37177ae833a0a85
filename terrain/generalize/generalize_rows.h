#pragma once

#include <vector>

namespace belvedere {

// The row loops of generalize(). They are plain loops over x without branches, compiled once for each vector width (Highway's dispatch) so
// that the compiler can vectorize them for the machine at hand; elementwise IEEE arithmetic without contraction gives the same
// bits at each width. "Padded" rows have that many values before and after the row.

// How curvature becomes c: least of |curvature| · scale and 1.
struct BreakLineScale {
  bool plan = false;      // N/g³, else N/g²
  float inverse_x = 1.F;  // 1 / width of a cell, 1/m
  float inverse_y = 1.F;  // 1 / height of a cell
  float scale_m = 1.F;    // mean cell / full curvature
};
// c of a row from three rows of altitudes, padded by 1.
void break_line_row(const float* north, const float* here, const float* south, int width, const BreakLineScale& scale, float* out);

// Sum of taps[k] · padded[x + k - radius]; taps has 2 radius + 1 values.
void blur_across_row(const float* padded, const std::vector<float>& taps, int width, float* out);
// Sum of taps[k] · rows[k][x].
void blur_down_row(const float* const* rows, const std::vector<float>& taps, int width, float* out);
// x^exponent for 0 ≤ x ≤ 1, in place, exponent > 0; error below 1e-5. Exactly 0 at 0 and 1 at 1.
void power_row(float* values, int width, float exponent);

// Of three rows of a band, padded by 1: the mean over 3 × 3 cells of P = p²r + 2pqs + q²t, whose sign is opposite to the profile
// curvature's, split into what is convex (max(-P, 0)) and |P|. P at the cell alone is 0 where the band is level, so along the very
// bottom of a valley and on the top of a roof; its mean tells there by the bend across, and on slopes by the bend along the fall.
void profile_row(const float* north, const float* here, const float* south, int width, float inverse_x, float inverse_y, float* convex,
                 float* both);
// Σ convex / Σ both over 3 × 3 cells, rows padded by 1: 1 where all the surroundings are convex, 0 where all are concave, .5 on a plane.
void convex_share_row(const float* const convex[3], const float* const both[3], int width, float* out);

// Everything that makes the weight of a cell. Null pointers mean: share 1, no break lines, mask 1, nothing kept, printable.
struct WeightRows {
  const float* share = nullptr;
  const float* break_line = nullptr;    // c
  const float* convex = nullptr;        // share of the ridge set against the valley set; null: they are the same
  const unsigned char* keep = nullptr;  // != 0: weight 1
  const float* mask = nullptr;
  const float* amplify = nullptr;  // mask of what is above 1
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
void weigh_row(const WeightRows& rows, const BandWeights& weights, const float* level, const float* smooth, int width, float* gain,
               float* out);

// out[x] = a[x] + b[x], and a[x] - b[x].
void add_row(const float* a, const float* b, int width, float* out);
void subtract_row(const float* a, const float* b, int width, float* out);

}  // namespace belvedere
