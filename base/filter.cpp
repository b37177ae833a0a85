#include "base/filter.h"

#include <array>
#include <cmath>
#include <vector>

#include "base/filter_lines.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

// Wider kernels work at half the resolution.
constexpr double widest_sampled_sigma = 8.0;

// Weights 0…radius of a symmetric, normalized Gaussian; every weight but the first counts twice.
std::vector<float> half_kernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<double> weights(static_cast<std::size_t>(radius) + 1);
  double sum = 0.0;
  for (int i = 0; i <= radius; ++i) {
    const double u = i / sigma;
    weights[i] = exact::exp(-0.5 * u * u);
    sum += i == 0 ? weights[i] : 2.0 * weights[i];
  }
  std::vector<float> kernel(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) kernel[i] = static_cast<float>(weights[i] / sum);
  return kernel;
}

LineBundle convolve(const LineBundle& lines, const std::vector<float>& kernel) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  const LineBundle padded = replicate_ends(lines, radius, radius);
  LineBundle out(lines.count());
  for (int i = 0; i < lines.count(); ++i) {
    const float* center = padded[i + radius];
    std::array<float, LineBundle::lanes> sum;
    for (int l = 0; l < LineBundle::lanes; ++l) sum[l] = kernel[0] * center[l];
    for (int k = 1; k <= radius; ++k) {
      const float* before = padded[i + radius - k];
      const float* after = padded[i + radius + k];
      const float weight = kernel[k];
      for (int l = 0; l < LineBundle::lanes; ++l) sum[l] += weight * (before[l] + after[l]);
    }
    float* target = out[i];
    for (int l = 0; l < LineBundle::lanes; ++l) target[l] = sum[l];
  }
  return out;
}

// Half the resolution by [1 4 6 4 1] / 16: element j lies over 2 (j - 1). The first and the last element see nothing but the
// replicated border, so replicating the halved lines is exactly halving the replicated lines.
LineBundle halve(const LineBundle& lines) {
  const int count = (lines.count() + 2) / 2 + 2;
  const LineBundle padded = replicate_ends(lines, 4, 2 * (count - 2) + 3 - lines.count());
  LineBundle out(count);
  for (int j = 0; j < count; ++j) {
    const float* a = padded[2 * j];  // 2 (j - 1) - 2, moved by the padding
    float* target = out[j];
    constexpr int n = LineBundle::lanes;
    for (int l = 0; l < n; ++l) {
      target[l] = 0.375F * a[2 * n + l] + 0.25F * (a[n + l] + a[3 * n + l]) + 0.0625F * (a[l] + a[4 * n + l]);
    }
  }
  return out;
}

// Back to `count` elements with the cubic B-spline's refinement, [1 6 1] / 8 and [1 1] / 2.
LineBundle refine(const LineBundle& halved, int count) {
  LineBundle out(count);
  for (int i = 0; i < count; ++i) {
    const float* a = halved[i / 2];
    const float* b = halved[i / 2 + 1];
    const float* c = halved[i / 2 + 2];
    float* target = out[i];
    if (i % 2 == 0) {
      for (int l = 0; l < LineBundle::lanes; ++l) target[l] = 0.75F * b[l] + 0.125F * (a[l] + c[l]);
    } else {
      for (int l = 0; l < LineBundle::lanes; ++l) target[l] = 0.5F * (b[l] + c[l]);
    }
  }
  return out;
}

// How often the resolution is halved, and the kernel that remains: the same for every bundle, so made once.
struct BlurPlan {
  int halvings = 0;
  std::vector<float> kernel;
};

BlurPlan plan_blur(double sigma) {
  BlurPlan plan;
  for (; sigma > widest_sampled_sigma; ++plan.halvings) sigma = std::sqrt((sigma * sigma - 2.0) / 4.0);
  plan.kernel = half_kernel(sigma);
  return plan;
}

LineBundle blur(const LineBundle& lines, const BlurPlan& plan, int halvings_left) {
  if (halvings_left == 0) return convolve(lines, plan.kernel);
  return refine(blur(halve(lines), plan, halvings_left - 1), lines.count());
}

// Weights of the four coefficients around a place t in 0…1 after the second.
std::array<double, 4> bspline_weights(double t) {
  const double u = 1.0 - t;
  return {u * u * u / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0, (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0, t * t * t / 6.0};
}

// The whole cell at or before a place; places far outside the grid come to its border, so that an int can hold them.
int whole_cell(double& place, int count) {
  place = std::clamp(place, -4.0, count + 3.0);
  return static_cast<int>(std::floor(place));
}

}  // namespace

Grid<float> gaussian_blur(const Grid<float>& values, double sigma) { return gaussian_blur(values, sigma, sigma); }

Grid<float> gaussian_blur(const Grid<float>& values, double sigma_x, double sigma_y) {
  Grid<float> out = values;
  if (values.empty()) return out;
  if (sigma_x > 0.0) {
    const BlurPlan plan = plan_blur(sigma_x);
    transform_rows(out, [&](const LineBundle& rows) { return blur(rows, plan, plan.halvings); });
  }
  if (sigma_y > 0.0) {
    const BlurPlan plan = plan_blur(sigma_y);
    transform_columns(out, [&](const LineBundle& columns) { return blur(columns, plan, plan.halvings); });
  }
  return out;
}

float sample_bilinear(const Grid<float>& values, double x, double y) {
  const int x0 = whole_cell(x, values.width());
  const int y0 = whole_cell(y, values.height());
  const double tx = x - x0;
  const double ty = y - y0;
  const double top = (1.0 - tx) * values.clamped(x0, y0) + tx * values.clamped(x0 + 1, y0);
  const double bottom = (1.0 - tx) * values.clamped(x0, y0 + 1) + tx * values.clamped(x0 + 1, y0 + 1);
  return static_cast<float>((1.0 - ty) * top + ty * bottom);
}

float sample_bspline(const Grid<float>& values, double x, double y) {
  const int x0 = whole_cell(x, values.width());
  const int y0 = whole_cell(y, values.height());
  const std::array<double, 4> wx = bspline_weights(x - x0);
  const std::array<double, 4> wy = bspline_weights(y - y0);
  double sum = 0.0;
  for (int j = 0; j < 4; ++j) {
    double row = 0.0;
    for (int i = 0; i < 4; ++i) row += wx[i] * values.clamped(x0 - 1 + i, y0 - 1 + j);
    sum += wy[j] * row;
  }
  return static_cast<float>(sum);
}

}  // namespace belvedere
