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
#include "renderer/style/style_cumulus.h"

namespace belvedere {
namespace {

// The medians cover the upper part of the sky; below it, among summits, the last row continues.
constexpr double covered_rows = 0.8;
constexpr int octaves = 4;
constexpr double octave_share = 0.55;
// Streaks: noises whose kernels are streak_sigma times the finer sigma of their band, whose size is
// streak_size of the root of the sky's area. About streak_share of the variance of one of a row of
// such noises, each twice as large as the one before, lies in its band.
constexpr double streak_sigma = 1.4;
constexpr double streak_size = 1.0 / 90.0;
constexpr double streak_share = 0.3;
constexpr double max_streak_variance = 0.8;
constexpr int first_streak = 16;  // numbers of random streams: octaves, cumulus from 8, streaks
// Min ratio of a cloud's width to its height; level strokes of the painting add up to
// level_flatness.
constexpr double min_flatness = 1.5;
constexpr double level_flatness = 3.0;

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
    const double finer = sky_sigma_per_length / (1 << octave);
    const Grid<float> noise =
        make_image_noise(stream_seed(parameters.seed, Stream::style_sky,
                                     static_cast<std::uint64_t>(which * octaves + octave)),
                         window.origin_px, window.width, window.height, ppu,
                         std::max(finer * length_x, 0.4), std::max(finer * length_y, 0.4));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<float>(share) * noise[i];
    squares += share * share;
  }
  // The finer scales of a painting contrast more than such octaves do.
  std::array<double, 3> variances{};
  double finer = 0.0;
  for (std::size_t k = 0; k < variances.size(); ++k) {
    variances[k] = change.streaks[k] * change.streaks[k] / streak_share;
    finer += variances[k];
  }
  const double fits = std::min(1.0, max_streak_variance / std::max(finer, 1e-9));
  const auto even = static_cast<float>(std::sqrt((1.0 - fits * finer) / squares));
  for (float& value : sum) value *= even;
  const double sigma = streak_sigma * streak_size *
                       std::sqrt(static_cast<double>(parameters.sheet_px.x) * parameters.sky_rows) /
                       ppu;
  for (std::size_t k = 0; k < variances.size(); ++k) {
    if (!(variances[k] > 0.0)) continue;
    const double own = sigma * (1 << k);
    const Grid<float> noise = make_image_noise(
        stream_seed(parameters.seed, Stream::style_sky,
                    static_cast<std::uint64_t>(first_streak + 3 * which) + k),
        window.origin_px, window.width, window.height, ppu,
        std::max(own * std::sqrt(flatness), 0.4), std::max(own / std::sqrt(flatness), 0.4));
    const auto strength = static_cast<float>(std::sqrt(fits * variances[k]));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += strength * noise[i];
  }
  return sum;
}

}  // namespace

double shaped_amount(const StyleSkyChange& change, double normal) {
  const auto& at = sky_quantile_deviates;
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
  const int first = rows->first;
  const int end = rows->second;
  const SkyWindow window{{origin_px.x, origin_px.y + first}, lab.width(), end - first};
  const std::array<Grid<float>, 3> medians = spline_of(sky.medians);
  const double level = style.brushwork[static_cast<std::size_t>(LandCoverClass::sky)].level;
  const double flatness = min_flatness + level_flatness * std::clamp(level, 0.0, 1.0);
  std::vector<Grid<float>> noises;
  for (std::size_t i = 0; i < sky.changes.size(); ++i)
    noises.push_back(
        change_noise(sky.changes[i], static_cast<int>(i), flatness, window, parameters));
  const StyleCumulus cumulus(sky, window, parameters);
  const double down = sky.medians.height() / (covered_rows * parameters.sky_rows);
  const double across = sky.medians.width() / static_cast<double>(parameters.sheet_px.x);
  const float share = static_cast<float>(parameters.sky);
  parallel_ranges(window.height, 8, [&](int begin, int last) {
    for (int row = begin; row != last; ++row) {
      const double v = (window.origin_px.y + row + 0.5) * down - 0.5;
      const float in_row = cumulus.share(row);
      for (int x = 0; x < window.width; ++x) {
        const std::size_t i = lab.index(x, first + row);
        if (!guidance.is_sky(i)) continue;
        const double u = (origin_px.x + x + 0.5) * across - 0.5;
        glm::vec3 colour;
        for (int c = 0; c < 3; ++c) colour[c] = sample_bspline(medians[c], u, v);
        glm::vec3 change(0.0F);
        for (std::size_t k = 0; k < noises.size(); ++k) {
          double deviate = noises[k](x, row);
          if (k == 0 && in_row > 0.0F) deviate += in_row * (cumulus.deviate(x, row) - deviate);
          change +=
              sky.changes[k].axis * static_cast<float>(shaped_amount(sky.changes[k], deviate));
        }
        if (in_row > 0.0F)
          change = glm::mix(change, sky.clear, in_row * (1.0F - cumulus.cover(x, row)));
        lab[i] = glm::mix(lab[i], colour + change, share);
      }
    }
  });
}

}  // namespace belvedere
