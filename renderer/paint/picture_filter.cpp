#include "renderer/paint/picture_filter.h"

#include <utility>
#include <vector>

#include "base/math_exact.h"
#include "base/parallel.h"

// Highway compiles the first part of this file once for each vector width.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/paint/picture_filter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef BELVEDERE_SURFACE_LINE
#define BELVEDERE_SURFACE_LINE
namespace belvedere {
// Pixels of one row, and the neighbours along a line: `before` of them up or to the left, `after`
// down or to the right.
struct SurfaceLine {
  const float* values;
  const float* depth_m;
  std::ptrdiff_t step;  // in values, from one neighbour to the next
  const float* kernel;  // from the centre on
  int before;
  int after;
};
}  // namespace belvedere
#endif

HWY_BEFORE_NAMESPACE();
namespace belvedere::filter {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Several pixels at once: the centre, then its neighbours in pairs outward. A neighbour on another
// surface adds 0, so there is no branch. Sums stay in registers throughout.
template <class D>
HWY_INLINE void BlurSurfacePixels(D d, const SurfaceLine& line, std::size_t x,
                                  float* HWY_RESTRICT out) {
  const float* values = line.values + x;
  const float* depth_m = line.depth_m + x;
  const auto own = hn::LoadU(d, depth_m);
  const auto tolerance = hn::Set(d, surface_tolerance);
  auto total = hn::Set(d, line.kernel[0]);
  auto sum = hn::Mul(total, hn::LoadU(d, values));
  const auto add = [&](std::ptrdiff_t to, float weight) HWY_ATTR {
    const auto other = hn::LoadU(d, depth_m + to);
    const auto near = hn::Le(hn::Abs(hn::Sub(own, other)), hn::Mul(tolerance, hn::Min(own, other)));
    const auto share = hn::IfThenElseZero(hn::Or(hn::Eq(own, other), near), hn::Set(d, weight));
    sum = hn::Add(sum, hn::Mul(share, hn::LoadU(d, values + to)));
    total = hn::Add(total, share);
  };
  const int both = std::min(line.before, line.after);
  const int max = std::max(line.before, line.after);
  for (int k = 1; k <= both; ++k) {
    add(-k * line.step, line.kernel[k]);
    add(k * line.step, line.kernel[k]);
  }
  for (int k = both + 1; k <= max; ++k)
    add((k <= line.before ? -k : k) * line.step, line.kernel[k]);
  hn::StoreU(hn::Div(sum, total), d, out + x);
}

void BlurSurfaceLine(const SurfaceLine& line, int count, float* HWY_RESTRICT out) {
  const hn::ScalableTag<float> wide;
  const hn::CappedTag<float, 1> single;
  const std::size_t pixels = static_cast<std::size_t>(count);
  std::size_t x = 0;
  for (; x + hn::Lanes(wide) <= pixels; x += hn::Lanes(wide)) BlurSurfacePixels(wide, line, x, out);
  for (; x < pixels; ++x) BlurSurfacePixels(single, line, x, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace belvedere::filter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace belvedere {
namespace filter {
HWY_EXPORT(BlurSurfaceLine);
}  // namespace filter
namespace {

constexpr double widest_direct_sigma_px = 16.0;

int kernel_radius(double sigma_px) { return static_cast<int>(std::ceil(3.0 * sigma_px)); }

std::vector<float> half_kernel(double sigma_px) {
  std::vector<float> kernel;
  for (int i = 0; i <= kernel_radius(sigma_px); ++i)
    kernel.push_back(static_cast<float>(exact::exp(-0.5 * i * i / (sigma_px * sigma_px))));
  return kernel;
}

// Side of the cells that replace pixels; 1: none.
int cell_side_px(double sigma_px) {
  return sigma_px <= widest_direct_sigma_px
             ? 1
             : static_cast<int>(std::floor(sigma_px / (0.5 * widest_direct_sigma_px)));
}

// Separable and direct. Sums run in a fixed order around each pixel.
Grid<float> blur_directly(const Grid<float>& values, double sigma) {
  std::vector<float> kernel = half_kernel(sigma);
  float total = kernel[0];
  for (std::size_t k = 1; k < kernel.size(); ++k) total += 2.0F * kernel[k];
  for (float& weight : kernel) weight /= total;
  const int radius = static_cast<int>(kernel.size()) - 1;
  const int width = values.width();
  const int height = values.height();
  Grid<float> across(width, height);
  parallel_rows(height, [&](int y) {
    std::vector<float> line(static_cast<std::size_t>(width + 2 * radius));
    for (int x = 0; x < width + 2 * radius; ++x)
      line[static_cast<std::size_t>(x)] = values.clamped(x - radius, y);
    float* out = across.row(y);
    const float* centre = line.data() + radius;
    for (int x = 0; x < width; ++x) out[x] = kernel[0] * centre[x];
    for (int k = 1; k <= radius; ++k) {
      const float weight = kernel[static_cast<std::size_t>(k)];
      for (int x = 0; x < width; ++x) out[x] += weight * (centre[x - k] + centre[x + k]);
    }
  });
  Grid<float> blurred(width, height);
  parallel_rows(height, [&](int y) {
    float* out = blurred.row(y);
    const float* here = across.row(y);
    for (int x = 0; x < width; ++x) out[x] = kernel[0] * here[x];
    for (int k = 1; k <= radius; ++k) {
      const float weight = kernel[static_cast<std::size_t>(k)];
      const float* above = across.row(std::max(y - k, 0));
      const float* below = across.row(std::min(y + k, height - 1));
      for (int x = 0; x < width; ++x) out[x] += weight * (above[x] + below[x]);
    }
  });
  return blurred;
}

// Distance between the neighbours that a blur on a surface reads: at most sigma/8, visually the
// same as reading all.
int surface_stride_px(double sigma_px) {
  return std::max(1, static_cast<int>(std::floor(sigma_px / (0.5 * widest_direct_sigma_px))));
}

int floor_divide(int value, int divisor) {
  return value >= 0 ? value / divisor : -((-value + divisor - 1) / divisor);
}

// Two neighbouring wide pixels, and the distance of a sheet pixel from the first; depends only on
// its absolute position.
struct Between {
  int low = 0;
  int high = 0;
  float share = 0.0F;
};

Between between(int sheet, int factor, int origin, int count) {
  const int twice =
      2 * sheet + 1 -
      factor;  // twice the distance from the centre of wide pixel 0, in pixels of the sheet
  const int first = twice >= 0 ? twice / (2 * factor) : -1;
  return {std::clamp(first - origin, 0, count - 1), std::clamp(first + 1 - origin, 0, count - 1),
          static_cast<float>(twice - first * 2 * factor) / static_cast<float>(2 * factor)};
}

// The row of a column of wide pixels nearest to `centre` that lies on the surface at a depth. The
// row below is preferred to the one above, because what rose was lower before. -1: none within
// surface_look_rows.
int row_on_surface(const WideView& wide, int x, int centre, float depth_m) {
  const auto lies_on = [&](int y) {
    return y >= 0 && y < wide.seen.height() && same_surface(depth_m, wide.seen.depth_m(x, y));
  };
  for (int away = 0; away <= surface_look_rows; ++away) {
    if (lies_on(centre + away)) return centre + away;
    if (lies_on(centre - away)) return centre - away;
  }
  return -1;
}

}  // namespace

Grid<float> blur_on_surface(const Grid<float>& values, const Grid<float>& depth_m, double sigma_px,
                            PixelRect wanted) {
  const int stride = surface_stride_px(sigma_px);
  const std::vector<float> kernel = half_kernel(sigma_px / stride);
  const int radius = static_cast<int>(kernel.size()) - 1;
  const PixelRect whole{0, 0, values.width(), values.height()};
  if (wanted.empty()) wanted = whole;
  // One pass along a line; each uses the surface of its own centre.
  const auto pass = [&](const Grid<float>& in, PixelRect at, bool across) {
    Grid<float> out(whole.x1, whole.y1);
    const int step = stride * (across ? 1 : whole.x1);
    parallel_ranges(at.height(), 8, [&](int begin, int end) {
      for (int y = at.y0 + begin; y < at.y0 + end; ++y) {
        const auto blur = [&](int x0, int x1, int before, int after) {
          if (x1 <= x0) return;
          const SurfaceLine line{in.row(y) + x0, depth_m.row(y) + x0,      step,
                                 kernel.data(),  std::min(before, radius), std::min(after, radius)};
          HWY_DYNAMIC_DISPATCH(filter::BlurSurfaceLine)(line, x1 - x0, out.row(y) + x0);
        };
        if (!across) {
          blur(at.x0, at.x1, y / stride, (whole.y1 - 1 - y) / stride);
          continue;
        }
        // Near the ends of a row each pixel lacks different neighbours.
        const int inner0 = std::clamp(radius * stride, at.x0, at.x1);
        const int inner1 = std::clamp(whole.x1 - radius * stride, inner0, at.x1);
        for (int x = at.x0; x < inner0; ++x)
          blur(x, x + 1, x / stride, (whole.x1 - 1 - x) / stride);
        blur(inner0, inner1, radius, radius);
        for (int x = inner1; x < at.x1; ++x)
          blur(x, x + 1, x / stride, (whole.x1 - 1 - x) / stride);
      }
    });
    return out;
  };
  const PixelRect rows = intersection(
      whole, {wanted.x0, wanted.y0 - radius * stride, wanted.x1, wanted.y1 + radius * stride});
  return pass(pass(values, rows, true), wanted, false);
}

int surface_reach_px(double sigma_px) {
  const int stride = surface_stride_px(sigma_px);
  return kernel_radius(sigma_px / stride) * stride;
}

Grid<float> blur_in_picture(const Grid<float>& values, double sigma_px, glm::ivec2 origin_px) {
  const int side = cell_side_px(sigma_px);
  if (side == 1) return blur_directly(values, sigma_px);
  const int width = values.width();
  const int height = values.height();
  const int first_x = floor_divide(origin_px.x, side);
  const int first_y = floor_divide(origin_px.y, side);
  Grid<float> cells(floor_divide(origin_px.x + width - 1, side) - first_x + 1,
                    floor_divide(origin_px.y + height - 1, side) - first_y + 1);
  parallel_rows(cells.height(), [&](int j) {
    const int y0 = std::max((first_y + j) * side - origin_px.y, 0);
    const int y1 = std::min((first_y + j + 1) * side - origin_px.y, height);
    for (int i = 0; i < cells.width(); ++i) {
      const int x0 = std::max((first_x + i) * side - origin_px.x, 0);
      const int x1 = std::min((first_x + i + 1) * side - origin_px.x, width);
      float sum = 0.0F;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += values(x, y);
      cells(i, j) = sum / static_cast<float>((x1 - x0) * (y1 - y0));
    }
  });
  const Grid<float> blurred = blur_directly(cells, sigma_px / side);
  // Back between cell centres, bilinearly; the weights depend on the absolute position, so they are
  // the same in every part.
  const auto position = [side](int absolute, int first, int count) {
    const int twice =
        2 * absolute + 1 - side;  // twice the distance from the centre of cell 0, in pixels
    const int cell = floor_divide(twice, 2 * side);
    struct Place {
      int low, high;
      float share;
    };
    return Place{std::clamp(cell - first, 0, count - 1), std::clamp(cell + 1 - first, 0, count - 1),
                 static_cast<float>(twice - cell * 2 * side) / static_cast<float>(2 * side)};
  };
  Grid<float> out(width, height);
  parallel_rows(height, [&](int y) {
    const auto py = position(origin_px.y + y, first_y, cells.height());
    for (int x = 0; x < width; ++x) {
      const auto px = position(origin_px.x + x, first_x, cells.width());
      const float top =
          blurred(px.low, py.low) * (1.0F - px.share) + blurred(px.high, py.low) * px.share;
      const float bottom =
          blurred(px.low, py.high) * (1.0F - px.share) + blurred(px.high, py.high) * px.share;
      out(x, y) = top * (1.0F - py.share) + bottom * py.share;
    }
  });
  return out;
}

int blur_reach_px(double sigma_px) {
  const int side = cell_side_px(sigma_px);
  return side == 1 ? kernel_radius(sigma_px) : (kernel_radius(sigma_px / side) + 3) * side;
}

Grid<float> enlarge(const WideView& wide, const Grid<float>& values, PixelRect rect) {
  if (wide.factor == 1) return part_of(values, moved(rect, -wide.origin_px.x, -wide.origin_px.y));
  std::vector<Between> columns;
  columns.reserve(static_cast<std::size_t>(rect.width()));
  for (int x = rect.x0; x < rect.x1; ++x)
    columns.push_back(between(x, wide.factor, wide.origin_px.x, values.width()));
  Grid<float> out(rect.width(), rect.height());
  parallel_ranges(rect.height(), 16, [&](int begin, int end) {
    std::vector<float> line(static_cast<std::size_t>(values.width()));
    for (int y = begin; y != end; ++y) {
      const Between rows = between(rect.y0 + y, wide.factor, wide.origin_px.y, values.height());
      const float* above = values.row(rows.low);
      const float* below = values.row(rows.high);
      for (int x = 0; x < values.width(); ++x)
        line[static_cast<std::size_t>(x)] = above[x] * (1.0F - rows.share) + below[x] * rows.share;
      float* to = out.row(y);
      for (const Between& at : columns)
        *to++ = line[static_cast<std::size_t>(at.low)] * (1.0F - at.share) +
                line[static_cast<std::size_t>(at.high)] * at.share;
    }
  });
  return out;
}

float value_on_surface(const WideView& wide, const Grid<float>& values, int sheet_x, int sheet_y,
                       float depth_m) {
  if (wide.factor == 1) return values[index_on_surface(wide, sheet_x, sheet_y, depth_m)];
  const Between columns = between(sheet_x, wide.factor, wide.origin_px.x, values.width());
  const Between rows = between(sheet_y, wide.factor, wide.origin_px.y, values.height());
  float sum = 0.0F;
  float total = 0.0F;
  const auto add = [&](int x, int y, float weight) {
    if (!same_surface(depth_m, wide.seen.depth_m(x, y))) return;
    sum += weight * values(x, y);
    total += weight;
  };
  add(columns.low, rows.low, (1.0F - columns.share) * (1.0F - rows.share));
  add(columns.high, rows.low, columns.share * (1.0F - rows.share));
  add(columns.low, rows.high, (1.0F - columns.share) * rows.share);
  add(columns.high, rows.high, columns.share * rows.share);
  if (total > 0.0F) return sum / total;
  const int centre = wide.row(sheet_y);
  for (const auto& [x, weight] :
       {std::pair(columns.low, 1.0F - columns.share), std::pair(columns.high, columns.share)})
    if (const int y = row_on_surface(wide, x, centre, depth_m); y >= 0) add(x, y, weight);
  return total > 0.0F ? sum / total : values[wide.index(sheet_x, sheet_y)];
}

std::size_t index_on_surface(const WideView& wide, int sheet_x, int sheet_y, float depth_m) {
  const int x = wide.column(sheet_x);
  const int y = wide.row(sheet_y);
  const int found = row_on_surface(wide, x, y, depth_m);
  return wide.seen.depth_m.index(x, found >= 0 ? found : y);
}

}  // namespace belvedere
#endif
