#include "base/filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "base/lines/blur_lines.h"
#include "base/lines/bspline.h"
#include "base/math_exact.h"
#include "base/parallel.h"

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

// How often the resolution is halved, and the remaining kernel; computed once for all bundles.
struct BlurPlan {
  int halvings = 0;
  std::vector<float> kernel;
};

BlurPlan plan_blur(double sigma) {
  BlurPlan plan;
  for (; sigma > widest_sampled_sigma; ++plan.halvings)
    sigma = std::sqrt((sigma * sigma - 2.0) / 4.0);
  plan.kernel = half_kernel(sigma);
  return plan;
}

constexpr int columns_at_once = 16;  // a cache line

// A line in progress, with room for replicated elements on both sides (base/lines/blur_lines.h).
class PaddedLine {
 public:
  PaddedLine(int before, int count, int after, int step)
      : before_(before),
        count_(count),
        after_(after),
        step_(step),
        numbers_(std::make_unique_for_overwrite<float[]>(at(count + after))) {}
  int count() const { return count_; }
  // Element i, from -before to count + after - 1.
  float* operator[](int i) { return numbers_.get() + at(i); }
  // To be called when the elements are set.
  void replicate_ends() {
    for (int i = -before_; i < 0; ++i) std::copy_n((*this)[0], step_, (*this)[i]);
    for (int i = count_; i < count_ + after_; ++i)
      std::copy_n((*this)[count_ - 1], step_, (*this)[i]);
  }

 private:
  std::size_t at(int i) const {
    return static_cast<std::size_t>(before_ + i) * static_cast<std::size_t>(step_);
  }
  int before_;
  int count_;
  int after_;
  int step_;
  std::unique_ptr<float[]> numbers_;
};

// Of a halved line: its element j lies over 2 (j - 1). The first and last elements depend only on
// the replicated border, so replicating the halved line equals halving the replicated line.
int halved_count(int count) { return (count + 2) / 2 + 2; }

// A line with the room that blurring needs.
PaddedLine line_to_blur(int count, int step, const BlurPlan& plan, int halvings_left) {
  const int radius = static_cast<int>(plan.kernel.size()) - 1;
  if (halvings_left == 0) return {radius, count, radius, step};
  return {4, count, 2 * (halved_count(count) - 2) + 3 - count, step};
}

// `out`: as many elements as the line has.
void blur(PaddedLine& line, int step, const BlurPlan& plan, int halvings_left, float* out) {
  line.replicate_ends();
  if (halvings_left == 0)
    return blur_lines::convolve(line[0], line.count() * step, step, plan.kernel.data(),
                                static_cast<int>(plan.kernel.size()) - 1, out);
  PaddedLine halved = line_to_blur(halved_count(line.count()), step, plan, halvings_left - 1);
  blur_lines::halve(line[-4], halved.count(), step, halved[0]);
  const auto blurred = std::make_unique_for_overwrite<float[]>(
      static_cast<std::size_t>(halved.count()) * static_cast<std::size_t>(step));
  blur(halved, step, plan, halvings_left - 1, blurred.get());
  blur_lines::refine(blurred.get(), line.count(), step, out);
}

void blur_rows(const Grid<float>& values, double sigma, Grid<float>& out) {
  const BlurPlan plan = plan_blur(sigma);
  constexpr int rows_at_once = 16;
  parallel_ranges(values.height(), rows_at_once, [&](int begin, int end) {
    PaddedLine line = line_to_blur(values.width(), 1, plan, plan.halvings);
    for (int y = begin; y < end; ++y) {
      std::copy_n(values.row(y), values.width(), line[0]);
      blur(line, 1, plan, plan.halvings, out.row(y));
    }
  });
}

void blur_columns(Grid<float>& values, double sigma) {
  const BlurPlan plan = plan_blur(sigma);
  constexpr int n = columns_at_once;
  const int width = values.width();
  const int height = values.height();
  parallel_ranges((width + n - 1) / n, 1, [&](int begin, int end) {
    PaddedLine lines = line_to_blur(height, n, plan, plan.halvings);
    const auto blurred =
        std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(height) * n);
    for (int first = begin * n; first < std::min(end * n, width); first += n) {
      const int used = std::min(n, width - first);
      for (int y = 0; y < height; ++y) {
        const float* row = values.row(y) + first;
        std::copy_n(row, used, lines[y]);
        std::fill(lines[y] + used, lines[y] + n, row[used - 1]);
      }
      blur(lines, n, plan, plan.halvings, blurred.get());
      for (int y = 0; y < height; ++y)
        std::copy_n(blurred.get() + static_cast<std::ptrdiff_t>(y) * n, used,
                    values.row(y) + first);
    }
  });
}

// The cell at or before a position. Positions far outside the grid are clamped to its border so
// that they fit an int.
int whole_cell(double& position, int count) {
  position = std::clamp(position, -4.0, count + 3.0);
  return static_cast<int>(std::floor(position));
}

template <class Value, class Wide>
auto bilinear(const Grid<Value>& values, double x, double y, Wide&& wide) {
  const int x0 = whole_cell(x, values.width());
  const int y0 = whole_cell(y, values.height());
  const double tx = x - x0;
  const double ty = y - y0;
  const auto top =
      (1.0 - tx) * wide(values.clamped(x0, y0)) + tx * wide(values.clamped(x0 + 1, y0));
  const auto bottom =
      (1.0 - tx) * wide(values.clamped(x0, y0 + 1)) + tx * wide(values.clamped(x0 + 1, y0 + 1));
  return (1.0 - ty) * top + ty * bottom;
}

}  // namespace

Grid<float> gaussian_blur(const Grid<float>& values, double sigma) {
  return gaussian_blur(values, sigma, sigma);
}

Grid<float> gaussian_blur(const Grid<float>& values, double sigma_x, double sigma_y) {
  if (values.empty() || sigma_x <= 0.0) {
    Grid<float> out = values;
    if (!values.empty() && sigma_y > 0.0) blur_columns(out, sigma_y);
    return out;
  }
  Grid<float> out(values.width(), values.height());
  blur_rows(values, sigma_x, out);
  if (sigma_y > 0.0) blur_columns(out, sigma_y);
  return out;
}

float sample_bilinear(const Grid<float>& values, double x, double y) {
  return static_cast<float>(
      bilinear(values, x, y, [](float value) { return static_cast<double>(value); }));
}

glm::dvec2 sample_bilinear(const Grid<glm::vec2>& values, double x, double y) {
  return bilinear(values, x, y, [](glm::vec2 value) { return glm::dvec2(value); });
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
