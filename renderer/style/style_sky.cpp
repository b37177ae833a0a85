#include "renderer/style/style_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/filter.h"
#include "base/parallel.h"
#include "base/random_streams.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

// The medians cover the upper part of the sky; below it, among summits, the last row continues.
constexpr double covered_rows = 0.8;
constexpr int octaves = 4;
constexpr double octave_share = 0.55;
// Sigma of the first octave's kernel over the half-correlation length of the sum of octaves. A
// single Gaussian has .6; finer octaves shorten the correlation of the sum.
constexpr double sigma_per_length = 1.28;
// Min ratio of a cloud's width to its height; level strokes of the painting add up to
// level_flatness.
constexpr double min_flatness = 1.5;
constexpr double level_flatness = 3.0;
// Normal deviates at the shares of StyleSkyChange::quantiles.
constexpr std::array<double, 7> normal_deviates = {-2.054, -1.282, -0.674, 0.0,
                                                   0.674,  1.282,  2.054};

// The range of rows of the window that contain sky; nothing where there is none.
std::optional<std::pair<int, int>> rows_of_sky(const GuidanceBuffers& guidance) {
  int first = guidance.height();
  int end = 0;
  for (int y = 0; y < guidance.height(); ++y)
    for (int x = 0; x < guidance.width(); ++x)
      if (guidance.is_sky(guidance.depth_m.index(x, y))) {
        first = std::min(first, y);
        end = y + 1;
        break;
      }
  if (first >= end) return std::nullopt;
  return std::pair(first, end);
}

// B-spline coefficients of L, a and b that approximately interpolate the colours. The colours
// themselves as coefficients would be smoothed too much.
std::array<Grid<float>, 3> spline_of(const Grid<glm::vec3>& colours) {
  std::array<Grid<float>, 3> planes;
  for (int c = 0; c < 3; ++c) {
    planes[c] = Grid<float>(colours.width(), colours.height());
    for (int y = 0; y < colours.height(); ++y)
      for (int x = 0; x < colours.width(); ++x) {
        const float own = colours(x, y)[c];
        const auto bend = [&](int dx, int dy) {
          return colours.clamped(x + dx, y + dy)[c] + colours.clamped(x - dx, y - dy)[c] -
                 2.0F * own;
        };
        planes[c](x, y) = own - (bend(1, 0) + bend(0, 1)) / 6.0F;
      }
  }
  return planes;
}

struct SkyWindow {
  glm::ivec2 origin_px;
  int width;
  int height;
};

Grid<float> change_noise(const StyleSkyChange& change, int which, double flatness,
                         const SkyWindow& window, const StylePaintParameters& parameters) {
  const double ppu = parameters.pixels_per_unit;
  double length_x = change.length_x * parameters.sheet_px.x / ppu;
  double length_y = change.length_y * parameters.sky_rows / ppu;
  // In a sky much taller than the painting's, clouds would become upright: flatten, keeping the
  // area.
  if (const double flatter = flatness * length_y / length_x; flatter > 1.0) {
    length_x *= std::sqrt(flatter);
    length_y /= std::sqrt(flatter);
  }
  Grid<float> sum(window.width, window.height, 0.0F);
  double squares = 0.0;
  double share = 1.0;
  for (int octave = 0; octave < octaves; ++octave, share *= octave_share) {
    const double finer = sigma_per_length / (1 << octave);
    const Grid<float> noise =
        make_image_noise(stream_seed(parameters.seed, Stream::style_sky,
                                     static_cast<std::uint64_t>(which * octaves + octave)),
                         window.origin_px, window.width, window.height, ppu,
                         std::max(finer * length_x, 0.4), std::max(finer * length_y, 0.4));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<float>(share) * noise[i];
    squares += share * share;
  }
  const float even = static_cast<float>(1.0 / std::sqrt(squares));
  for (float& value : sum) value *= even;
  return sum;
}

}  // namespace

double shaped_amount(const StyleSkyChange& change, double normal) {
  const auto& at = normal_deviates;
  if (normal <= at.front()) return change.quantiles.front();
  if (normal >= at.back()) return change.quantiles.back();
  std::size_t i = 0;
  while (normal > at[i + 1]) ++i;
  const double t = (normal - at[i]) / (at[i + 1] - at[i]);
  return change.quantiles[i] * (1.0 - t) + change.quantiles[i + 1] * t;
}

void paint_style_sky(Grid<glm::vec3>& lab, const Style& style, const GuidanceBuffers& guidance,
                     const StylePaintParameters& parameters, glm::ivec2 origin_px) {
  const StyleSky& sky = style.sky;
  if (sky.medians.empty() || parameters.sky_rows <= 0 || parameters.sky <= 0.0) return;
  const auto rows = rows_of_sky(guidance);
  if (!rows) return;
  const auto [first, end] = *rows;
  const SkyWindow window{{origin_px.x, origin_px.y + first}, lab.width(), end - first};
  const std::array<Grid<float>, 3> medians = spline_of(sky.medians);
  const double level = style.brushwork[static_cast<std::size_t>(LandCoverClass::sky)].level;
  const double flatness = min_flatness + level_flatness * std::clamp(level, 0.0, 1.0);
  std::vector<Grid<float>> noises;
  for (std::size_t i = 0; i < sky.changes.size(); ++i)
    noises.push_back(
        change_noise(sky.changes[i], static_cast<int>(i), flatness, window, parameters));
  const double down = sky.medians.height() / (covered_rows * parameters.sky_rows);
  const double across = sky.medians.width() / static_cast<double>(parameters.sheet_px.x);
  const float share = static_cast<float>(parameters.sky);
  parallel_ranges(window.height, 8, [&](int begin, int last) {
    for (int row = begin; row != last; ++row) {
      const double v = (window.origin_px.y + row + 0.5) * down - 0.5;
      for (int x = 0; x < window.width; ++x) {
        const std::size_t i = lab.index(x, first + row);
        if (!guidance.is_sky(i)) continue;
        const double u = (origin_px.x + x + 0.5) * across - 0.5;
        glm::vec3 colour;
        for (int c = 0; c < 3; ++c) colour[c] = sample_bspline(medians[c], u, v);
        for (std::size_t k = 0; k < noises.size(); ++k)
          colour += sky.changes[k].axis *
                    static_cast<float>(shaped_amount(sky.changes[k], noises[k](x, row)));
        lab[i] = glm::mix(lab[i], colour, share);
      }
    }
  });
}

}  // namespace belvedere
