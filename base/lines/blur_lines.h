#pragma once

namespace belvedere::blur_lines {

// The inner loops of gaussian_blur. The elements of a line are contiguous, `step` numbers each: 1
// for a row of a grid, more for several columns side by side, which are blurred together.
// Operations are done in the order written here, without fused multiply-adds, so the result does
// not depend on the vector width.

// out[j] = kernel[0] · middle[j] + Σ kernel[k] · (middle[j - k step] + middle[j + k step]), k = 1 …
// radius in this order, for j < count.
void convolve(const float* centre, int count, int step, const float* kernel, int radius,
              float* out);

// Half the resolution by [1 4 6 4 1] / 16: element j < count of `out` from elements 2 j … 2 j + 4
// of `lines`.
void halve(const float* lines, int count, int step, float* out);

// Twice the resolution with the cubic B-spline's refinement, [1 6 1] / 8 and [1 1] / 2: elements 2
// m and 2 m + 1 of `out` from m … m + 2 of `halved`, `count` elements in all.
void refine(const float* halved, int count, int step, float* out);

}  // namespace belvedere::blur_lines
