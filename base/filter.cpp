#include "base/filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "base/lines/blur_lines.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pyramid.h"

// Minimum, maximum and nearest-mark filters: exact, at a cost that does not depend on the radius.

namespace belvedere {
namespace {

// For separable filters: sixteen neighbouring rows or columns interleaved, element i of all of them
// in one cache line. One filter then works for both directions, and the compiler vectorizes its
// inner loop over the lanes.
class LineBundle {
 public:
  static constexpr int lanes = 16;
  explicit LineBundle(int count)
      : count_(count), values_(static_cast<std::size_t>(count) * lanes) {}
  int count() const { return count_; }
  // The sixteen values of element i.
  float* operator[](int i) { return values_.data() + static_cast<std::ptrdiff_t>(i) * lanes; }
  const float* operator[](int i) const {
    return values_.data() + static_cast<std::ptrdiff_t>(i) * lanes;
  }

 private:
  int count_;
  std::vector<float> values_;
};

// The lines with `before` copies of their first and `after` copies of their last element.
inline LineBundle replicate_ends(const LineBundle& lines, int before, int after) {
  LineBundle out(before + lines.count() + after);
  const int last = lines.count() - 1;
  for (int i = 0; i < before; ++i) std::copy_n(lines[0], LineBundle::lanes, out[i]);
  std::copy_n(lines[0], static_cast<std::ptrdiff_t>(lines.count()) * LineBundle::lanes,
              out[before]);
  for (int i = 0; i < after; ++i)
    std::copy_n(lines[last], LineBundle::lanes, out[before + lines.count() + i]);
  return out;
}

// Replaces every row by filter(LineBundle), which must keep the count. Spare lanes repeat the last
// row.
template <class F>
void transform_rows(Grid<float>& values, F&& filter) {
  constexpr int n = LineBundle::lanes;
  const int height = values.height();
  parallel_rows((height + n - 1) / n, [&](int bundle) {
    const int first = bundle * n;
    LineBundle lines(values.width());
    for (int l = 0; l < n; ++l) {
      const float* row = values.row(std::min(first + l, height - 1));
      for (int x = 0; x < values.width(); ++x) lines[x][l] = row[x];
    }
    const LineBundle filtered = filter(lines);
    for (int l = 0; l < std::min(n, height - first); ++l) {
      float* row = values.row(first + l);
      for (int x = 0; x < values.width(); ++x) row[x] = filtered[x][l];
    }
  });
}

// The same for columns.
template <class F>
void transform_columns(Grid<float>& values, F&& filter) {
  constexpr int n = LineBundle::lanes;
  const int width = values.width();
  parallel_rows((width + n - 1) / n, [&](int bundle) {
    const int first = bundle * n;
    const int used = std::min(n, width - first);
    LineBundle lines(values.height());
    for (int y = 0; y < values.height(); ++y) {
      const float* row = values.row(y) + first;
      std::copy_n(row, used, lines[y]);
      std::fill(lines[y] + used, lines[y] + n, row[used - 1]);
    }
    const LineBundle filtered = filter(lines);
    for (int y = 0; y < values.height(); ++y) std::copy_n(filtered[y], used, values.row(y) + first);
  });
}

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

// Length of a halved line: its element j lies over 2 (j - 1). The first and last elements depend
// only on the replicated border, so replicating the halved line equals halving the replicated line.
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

namespace {

// van Herk & Gil-Werman: running extremes from each block's start and to each block's end; a window
// as long as a block spans two.
template <class Pick>
LineBundle window_extreme(const LineBundle& lines, int radius, Pick pick) {
  constexpr int n = LineBundle::lanes;
  const int window = 2 * radius + 1;
  const LineBundle padded = replicate_ends(lines, radius, radius);
  LineBundle from_start = padded;
  LineBundle to_end = padded;
  for (int i = 1; i < padded.count(); ++i) {
    if (i % window == 0) continue;
    for (int l = 0; l < n; ++l) from_start[i][l] = pick(from_start[i - 1][l], from_start[i][l]);
  }
  for (int i = padded.count() - 2; i >= 0; --i) {
    if ((i + 1) % window == 0) continue;
    for (int l = 0; l < n; ++l) to_end[i][l] = pick(to_end[i + 1][l], to_end[i][l]);
  }
  LineBundle out(lines.count());
  for (int i = 0; i < lines.count(); ++i) {
    for (int l = 0; l < n; ++l) out[i][l] = pick(to_end[i][l], from_start[i + window - 1][l]);
  }
  return out;
}

template <class Pick>
Grid<float> filter_window(const Grid<float>& values, int radius, Pick pick) {
  Grid<float> out = values;
  if (values.empty() || radius <= 0) return out;
  const int radius_x = std::min(radius, values.width() - 1);
  const int radius_y = std::min(radius, values.height() - 1);
  transform_rows(out,
                 [&](const LineBundle& lines) { return window_extreme(lines, radius_x, pick); });
  transform_columns(out,
                    [&](const LineBundle& lines) { return window_extreme(lines, radius_y, pick); });
  return out;
}

// Row of the nearest mark within each column, -1 if the column has none; ties go to the upper one.
Grid<std::int32_t> nearest_in_columns(const Grid<std::uint8_t>& mask) {
  const int width = mask.width();
  const int height = mask.height();
  Grid<std::int32_t> nearest(width, height, -1);
  parallel_tiles(width, 1, 64, [&](PixelRect columns) {
    for (int y = 0; y < height; ++y) {
      for (int x = columns.x0; x < columns.x1; ++x) {
        if (mask(x, y) != 0) {
          nearest(x, y) = y;
        } else if (y > 0) {
          nearest(x, y) = nearest(x, y - 1);
        }
      }
    }
    std::vector<std::int32_t> below(static_cast<std::size_t>(columns.width()), -1);
    for (int y = height - 1; y >= 0; --y) {
      for (int x = columns.x0; x < columns.x1; ++x) {
        std::int32_t& lower = below[static_cast<std::size_t>(x - columns.x0)];
        if (mask(x, y) != 0) lower = y;
        const std::int32_t upper = nearest(x, y);
        if (lower >= 0 && (upper < 0 || lower - y < y - upper)) nearest(x, y) = lower;
      }
    }
  });
  return nearest;
}

// The mark of one column as a parabola of the squared distance along the row.
struct Parabola {
  std::int64_t x;
  std::int64_t mark_y;
  std::int64_t height;  // squared distance to the row
  std::int64_t from;    // first x of the row at which it is the nearest
};

// Last x at which the left parabola is preferred to the right one: nearer, or equally near with the
// lower index. Two parabolas of one shape cross once, so the preference changes once along the row,
// ties included.
std::int64_t last_preferred(const Parabola& left, const Parabola& right) {
  const std::int64_t numerator = right.x * right.x + right.height - left.x * left.x - left.height;
  const std::int64_t denominator = 2 * (right.x - left.x);
  std::int64_t quotient = numerator / denominator;
  if (numerator % denominator < 0) --quotient;  // floor
  const bool tie = quotient * denominator == numerator;
  const bool left_is_lower =
      left.mark_y <= right.mark_y;  // in the same row left.x < right.x decides
  return tie && !left_is_lower ? quotient - 1 : quotient;
}

}  // namespace

Grid<float> window_minimum(const Grid<float>& values, int radius) {
  return filter_window(values, radius, [](float a, float b) { return b < a ? b : a; });
}

Grid<float> window_maximum(const Grid<float>& values, int radius) {
  return filter_window(values, radius, [](float a, float b) { return b > a ? b : a; });
}

Grid<std::int32_t> nearest_marked(const Grid<std::uint8_t>& mask) {
  const int width = mask.width();
  Grid<std::int32_t> nearest = nearest_in_columns(mask);
  parallel_rows(mask.height(), [&](int y) {
    std::vector<Parabola> envelope;
    envelope.reserve(static_cast<std::size_t>(width));
    std::int32_t* row = nearest.row(y);
    for (int x = 0; x < width; ++x) {
      if (row[x] < 0) continue;
      const std::int64_t dy = row[x] - y;
      Parabola next{x, row[x], dy * dy, std::numeric_limits<std::int64_t>::min()};
      while (!envelope.empty()) {
        const std::int64_t last = last_preferred(envelope.back(), next);
        if (last >= envelope.back().from) {
          next.from = last + 1;
          break;
        }
        envelope.pop_back();
      }
      envelope.push_back(next);
    }
    if (envelope.empty()) return;  // no mark anywhere: all -1
    std::size_t current = 0;
    for (int x = 0; x < width; ++x) {
      while (current + 1 < envelope.size() && envelope[current + 1].from <= x) ++current;
      row[x] = static_cast<std::int32_t>(envelope[current].mark_y * width + envelope[current].x);
    }
  });
  return nearest;
}

}  // namespace belvedere
