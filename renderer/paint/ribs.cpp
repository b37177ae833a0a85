#include "renderer/paint/ribs.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

constexpr double sample_spacing_units = 2.0;  // between the samples of a streamline
constexpr double blur_sigma_units = 0.5;      // hides the steps of nearest sampling
constexpr double relief_gain = 0.81;  // the trial value divided by a deviation that included the
                                      // sky: .805, .811, .853 for its three widths

// Deviation of a sum of `count` samples `sample_spacing_units` apart of noise with the
// autocorrelation exp(-r²/(4 sigma²)), that of white noise under a Gaussian.
double line_sum_deviation(int count, double sigma_units) {
  double variance = count;
  for (int k = 1; k < count; ++k) {
    const double r = k * sample_spacing_units / sigma_units;
    variance += 2.0 * (count - k) * exact::exp(-0.25 * r * r);
  }
  return std::sqrt(variance);
}

bool any_marked(const Grid<std::uint8_t>& marks, PixelRect rect) {
  for (int y = std::max(rect.y0, 0); y < std::min(rect.y1, marks.height()); ++y)
    for (int x = std::max(rect.x0, 0); x < std::min(rect.x1, marks.width()); ++x)
      if (marks(x, y) != 0) return true;
  return false;
}

int steps_each_way(const RibWidth& width) {
  return static_cast<int>(width.length_units / 2.0 / sample_spacing_units);
}

// The noises of the three widths at one pixel, stored together because every step reads all of
// them.
using NoiseTriple = glm::vec3;

// A streamline down (sign 1) or up the fall line from a pixel of the sheet. Positions are relative
// to the pixel, so that rounding does not depend on the part of the picture.
struct Streamline {
  glm::ivec2 sheet_px{0};
  float sign = 1.0F;
  glm::vec2 fall{0.0F};  // at its current position, as is depth
  float depth_m = 0.0F;
  bool bound = true;  // still on the surface where it began
  glm::vec2 offset{0.0F};
  glm::vec2 direction{0.0F};
  NoiseTriple sum{0.0F};
};

// WideView::index for many positions: multiplies by 2^32 / factor, rounded up, which divides
// exactly below 2^24 for factors below 256.
class WidePlaces {
 public:
  explicit WidePlaces(const WideView& wide)
      : origin_(wide.origin_px),
        last_(wide.seen.width() - 1, wide.seen.height() - 1),
        width_(static_cast<std::size_t>(wide.seen.width())),
        inverse_((std::uint64_t{1} << 32U) / static_cast<std::uint64_t>(wide.factor) + 1) {}
  std::size_t index(int sheet_x, int sheet_y) const {
    return static_cast<std::size_t>(position(sheet_y, origin_.y, last_.y)) * width_ +
           static_cast<std::size_t>(position(sheet_x, origin_.x, last_.x));
  }

 private:
  int position(int sheet, int origin, int last) const {
    const int wide =
        static_cast<int>(static_cast<std::uint64_t>(std::max(sheet, 0)) * inverse_ >> 32U);
    return std::clamp(wide - origin, 0, last);
  }
  glm::ivec2 origin_;
  glm::ivec2 last_;
  std::size_t width_;
  std::uint64_t inverse_;
};

// Sums of the noises (of wide pixels) along streamlines, without their first pixels, each width
// over its own length. All lines advance together, one step at a time, to hide the latency of the
// reads.
void integrate(const WideView& wide, const WidePlaces& positions, const Grid<NoiseTriple>& noise,
               float step_px, std::span<Streamline> lines) {
  // In descending length: the widest continues when the others have ended.
  constexpr int longest = 2;
  constexpr int centre = 0;
  constexpr int shortest = 1;
  static_assert(rib_widths[longest].length_units >= rib_widths[centre].length_units &&
                rib_widths[centre].length_units >= rib_widths[shortest].length_units);
  const int steps_short = steps_each_way(rib_widths[shortest]);
  const int steps_middle = steps_each_way(rib_widths[centre]);
  const int steps_long = steps_each_way(rib_widths[longest]);
  for (int k = 0; k < steps_long; ++k)
    for (Streamline& line : lines) {
      if (line.bound && (line.fall.x != 0.0F || line.fall.y != 0.0F))
        line.direction = line.fall * line.sign;
      line.offset += line.direction * step_px;
      const std::size_t next =
          positions.index(line.sheet_px.x + static_cast<int>(std::floor(line.offset.x + 0.5F)),
                          line.sheet_px.y + static_cast<int>(std::floor(line.offset.y + 0.5F)));
      if (line.bound) {
        line.bound = same_surface(line.depth_m, wide.seen.depth_m[next]);
        line.depth_m = wide.seen.depth_m[next];
        line.fall = wide.seen.fall_line[next];
      }
      const NoiseTriple& value = noise[next];
      if (k < steps_short) line.sum[shortest] += value[shortest];
      if (k < steps_middle) line.sum[centre] += value[centre];
      line.sum[longest] += value[longest];
    }
}

// Slope of a field along x, per unit, on the same surface only.
float slope_across(const Grid<float>& field, const Grid<float>& depth_m, int x, int y, int reach_px,
                   float units) {
  const int left = std::max(x - reach_px, 0);
  const int right = std::min(x + reach_px, field.width() - 1);
  const float here = field(x, y);
  const float a = same_surface(depth_m(x, y), depth_m(left, y)) ? field(left, y) : here;
  const float b = same_surface(depth_m(x, y), depth_m(right, y)) ? field(right, y) : here;
  return (b - a) / (2.0F * units);
}

}  // namespace

std::array<Grid<float>, 3> integrate_along_fall_line(const GuidanceBuffers& guidance,
                                                     const WideView& wide,
                                                     const Grid<std::uint8_t>& marked,
                                                     std::uint64_t seed, glm::ivec2 origin_px,
                                                     double pixels_per_unit) {
  const int width = guidance.width();
  const int height = guidance.height();
  std::array<Grid<float>, 3> fields;
  for (Grid<float>& field : fields) field = Grid<float>(width, height, 0.0F);
  if (!any_marked(marked, {0, 0, width, height})) return fields;
  Grid<NoiseTriple> noise(wide.seen.width(), wide.seen.height());
  NoiseTriple scale(0.0F);
  for (int k = 0; k < 3; ++k) {
    const double sigma = rib_widths[k].sigma_units;
    const std::uint64_t lines = stream_seed(seed, Stream::rib_lines, static_cast<std::uint64_t>(k));
    const Grid<float> one = make_image_noise(lines, wide.origin_px, noise.width(), noise.height(),
                                             pixels_per_unit / wide.factor, sigma, sigma);
    parallel_ranges(one.size(), std::size_t{1} << 15U, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) noise[i][k] = one[i];
    });
    scale[k] =
        static_cast<float>(1.0 / line_sum_deviation(2 * steps_each_way(rib_widths[k]) + 1, sigma));
  }
  const auto step_px = static_cast<float>(sample_spacing_units * pixels_per_unit);
  const WidePlaces positions(wide);
  // Neighbours that slopes and the blur read.
  const int reach = static_cast<int>(std::ceil(pixels_per_unit)) +
                    blur_reach_px(blur_sigma_units * pixels_per_unit);
  parallel_tiles(width, height, 16, [&](PixelRect tile) {
    if (!any_marked(marked, {tile.x0 - reach, tile.y0 - reach, tile.x1 + reach, tile.y1 + reach}))
      return;
    std::array<Streamline, 8> lines;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x0 = tile.x0; x0 < tile.x1; x0 += static_cast<int>(lines.size()) / 2) {
        const int pixels = std::min(static_cast<int>(lines.size()) / 2, tile.x1 - x0);
        for (int i = 0; i < pixels; ++i) {
          const glm::ivec2 sheet_px = origin_px + glm::ivec2(x0 + i, y);
          for (const int way : {0, 1})
            lines[static_cast<std::size_t>(2 * i + way)] = {.sheet_px = sheet_px,
                                                            .sign = way == 0 ? 1.0F : -1.0F,
                                                            .fall = guidance.fall_line(x0 + i, y),
                                                            .depth_m = guidance.depth_m(x0 + i, y)};
        }
        integrate(wide, positions, noise, step_px,
                  std::span(lines).first(static_cast<std::size_t>(2 * pixels)));
        for (int i = 0; i < pixels; ++i) {
          const Streamline& down = lines[static_cast<std::size_t>(2 * i)];
          const Streamline& up = lines[static_cast<std::size_t>(2 * i + 1)];
          const NoiseTriple all =
              (noise[positions.index(down.sheet_px.x, down.sheet_px.y)] + down.sum + up.sum) *
              scale;
          for (int k = 0; k < 3; ++k) fields[k](x0 + i, y) = all[k];
        }
      }
  });
  return fields;
}

Grid<float> make_ribs(const GuidanceBuffers& guidance, const WideView& wide,
                      const Grid<std::uint8_t>& marked, const RibParameters& parameters,
                      glm::ivec2 origin_px) {
  const double ppu = parameters.pixels_per_unit;
  const int width = guidance.width();
  const int height = guidance.height();
  Grid<float> ribs(width, height, 0.0F);
  if (!any_marked(marked, {0, 0, width, height})) return ribs;
  std::array<Grid<float>, 3> fields =
      integrate_along_fall_line(guidance, wide, marked, parameters.seed, origin_px, ppu);
  for (Grid<float>& field : fields)
    field = blur_in_picture(field, blur_sigma_units * ppu, origin_px);
  // Slow random amplitudes: evenly strong ribs look like corrugated iron.
  const Grid<float> slow_a =
      make_image_noise(stream_seed(parameters.seed, Stream::rib_strengths, 0), origin_px, width,
                       height, ppu, 14.0, 14.0);
  const Grid<float> slow_b =
      make_image_noise(stream_seed(parameters.seed, Stream::rib_strengths, 1), origin_px, width,
                       height, ppu, 9.0, 9.0);
  const int reach_px = std::max(1, static_cast<int>(std::lround(ppu)));
  const auto reach_units = static_cast<float>(reach_px / ppu);
  const float one_side = parameters.sun_side < 0.0 ? -1.0F : 1.0F;
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (marked(x, y) == 0) continue;
      const std::array<float, 3> amplitude = {std::clamp(0.55F + 0.45F * slow_a(x, y), 0.05F, 1.3F),
                                              std::clamp(0.5F + 0.5F * slow_b(x, y), 0.0F, 1.3F),
                                              1.0F};
      const float side = parameters.sides.empty() ? one_side : parameters.sides(x, y);
      float light = 0.0F;
      for (int k = 0; k < 3; ++k) {
        const auto gain = static_cast<float>(relief_gain * rib_widths[k].sigma_units);
        const float slope =
            gain * slope_across(fields[k], guidance.depth_m, x, y, reach_px, reach_units);
        light -= side * rib_widths[k].strength * amplitude[k] * std::clamp(slope, -1.5F, 1.5F);
      }
      // The deepest hollows are dark on both sides.
      ribs(x, y) =
          light -
          0.25F * std::clamp(-static_cast<float>(relief_gain) * fields[0](x, y) - 0.8F, 0.0F, 1.0F);
    }
  });
  return ribs;
}

int rib_near_margin_px(double pixels_per_unit) {
  return blur_reach_px(blur_sigma_units * pixels_per_unit) +
         std::max(1, static_cast<int>(std::lround(pixels_per_unit))) + 2;
}

int rib_margin_px(double pixels_per_unit) {
  const double longest_units = rib_widths[2].length_units / 2.0 + 1.0;
  return static_cast<int>(std::ceil(longest_units * pixels_per_unit)) +
         rib_near_margin_px(pixels_per_unit);
}

}  // namespace belvedere
