#include "renderer/style/style_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/paint/picture_filter.h"
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

namespace {

// Sizes in units of the sheet.
constexpr double contrast_sigma_units = 14.0;
constexpr double bilateral_sigma_units = 2.0;  // doubled at vapour 1
constexpr double usual_contrast = 1.1;
constexpr double unevenness_of_forms = 0.5;  // of that of strokes
// Deviation between regions of log2 of the fine contrast of the program's pictures.
constexpr double program_unevenness = 0.38;
constexpr double max_missing_unevenness = 0.6;
// Standard deviation of L between sigma 2 and 12 px, measured on renders of the program's scenes.
constexpr double program_form_deviation = 0.058;
// Range sigma of the bilateral filter, OKLab.
constexpr float bilateral_tolerance = 0.07F;
// Shares of the painting's trend that are applied; haze already contains some of it.
constexpr glm::vec3 trend_share{0.6F, 0.35F, 0.35F};
// Strength of vapour far away and in valleys. Set by eye: with less, air was invisible; with more,
// ranges disappeared.
constexpr double min_vapour = 0.1;
constexpr double far_vapour = 0.22;
constexpr double valley_vapour = 0.16;
constexpr double valley_depth_m = 250.0;  // e-folding height above the lowest ground within 900 m
constexpr double max_vapour = 0.6;

float vapour_on(LandCoverClass id) {
  switch (id) {
    case LandCoverClass::water:
      return 0.3F;
    case LandCoverClass::snow:
    case LandCoverClass::glacier:
      return 0.5F;
    default:
      return 1.0F;
  }
}

// Colours of a style's air in front of ground, at medium distance and at the horizon.
struct Air {
  explicit Air(const Palette& palette)
      : middle(glm::vec3(0.3 * to_oklab(palette.haze_near) + 0.7 * to_oklab(palette.haze_far))),
        horizon(palette.sky.empty() ? middle : glm::vec3(to_oklab(palette.sky.back().second))) {}
  glm::vec3 middle;
  glm::vec3 horizon;
};

glm::vec3 in_air(glm::vec3 lab, const Style& style, const Air& air,
                 const StylePaintParameters& parameters, const GuidanceBuffers& guidance,
                 std::size_t i) {
  const double far = style_distance(parameters, guidance.depth_m[i]);
  const auto share = static_cast<float>(parameters.palette);
  lab += share * static_cast<float>(far - 0.5) * trend_share * style.trend;
  if (style.vapour <= min_vapour) return lab;
  const double low =
      guidance.valley_height_m.empty()
          ? 0.0
          : exact::exp(-std::max(0.0, static_cast<double>(guidance.valley_height_m[i])) /
                       valley_depth_m);
  const double thick = style.vapour * (far_vapour * far * std::sqrt(far) +
                                       valley_vapour * low * std::min(1.0, 0.25 + far));
  const float vapour =
      share * static_cast<float>(std::min(thick, max_vapour)) * vapour_on(guidance.land_cover[i]);
  const glm::vec3 colour = glm::mix(air.middle, air.horizon, 0.6F * static_cast<float>(far));
  return glm::mix(lab, colour, vapour);
}

// Factor on the contrast of medium-scale forms: the painting's relative to the program's. Strokes
// reduce this contrast, so the usual factor is above 1.
double form_contrast_of(const Style& style, const StylePaintParameters& parameters) {
  if (parameters.form_contrast > 0.0) return parameters.form_contrast;
  if (!(style.form_deviation > 0.0)) return usual_contrast;
  return std::clamp(usual_contrast * style.form_deviation / program_form_deviation, 0.92, 1.4);
}

// Strengthens the contrast of forms as large as mountain sides, on the ground only, with regional
// variation.
void strengthen_forms(Grid<glm::vec3>& lab, const Style& style, const GuidanceBuffers& guidance,
                      const StylePaintParameters& parameters, glm::ivec2 origin_px) {
  const double contrast_of_all = form_contrast_of(style, parameters);
  const double ppu = parameters.pixels_per_unit;
  Grid<float> light(lab.width(), lab.height());
  Grid<float> ground(lab.width(), lab.height());
  for (std::size_t i = 0; i < lab.size(); ++i) {
    ground[i] = guidance.is_sky(i) ? 0.0F : 1.0F;
    light[i] = ground[i] * lab[i].x;
  }
  light = blur_in_picture(light, contrast_sigma_units * ppu, origin_px);
  ground = blur_in_picture(ground, contrast_sigma_units * ppu, origin_px);
  const Grid<float> region =
      make_image_noise(stream_seed(parameters.seed, Stream::style_contrasts), origin_px,
                       lab.width(), lab.height(), ppu, style_region_units, style_region_units);
  const double uneven = unevenness_of_forms * missing_unevenness(style, parameters);
  parallel_ranges(lab.height(), 16, [&](int begin, int end) {
    for (std::size_t i = lab.index(0, begin); i < lab.index(0, end); ++i) {
      if (guidance.is_sky(i)) continue;
      const double more = std::clamp(static_cast<double>(region[i]), -1.5, 1.5);
      const auto contrast =
          static_cast<float>(contrast_of_all * exact::exp(std::numbers::ln2 * uneven * more));
      const float mean = light[i] / ground[i];
      lab[i].x = mean + contrast * (lab[i].x - mean);
    }
  });
}

// Taps of the bilateral filter: a sparse disc with a fixed number of taps, so that the cost per
// pixel does not depend on the size of the print.
struct BilateralKernel {
  struct Neighbour {
    int x, y;
    float weight;
  };
  std::vector<Neighbour> neighbours;
  int reach_px = 0;
};

double bilateral_sigma_px(const Style& style, const StylePaintParameters& parameters) {
  return bilateral_sigma_units * (1.0 + style.vapour) * parameters.pixels_per_unit;
}

BilateralKernel bilateral_kernel(double sigma_px) {
  constexpr int rings = 3;
  const int step = std::max(1, static_cast<int>(sigma_px * 1.5 / rings + 0.5));
  BilateralKernel kernel;
  kernel.reach_px = rings * step;
  for (int y = -rings; y <= rings; ++y)
    for (int x = -rings; x <= rings; ++x) {
      if (x * x + y * y > rings * rings + 1) continue;
      const double square = static_cast<double>(x * x + y * y) * step * step;
      kernel.neighbours.push_back(
          {x * step, y * step,
           static_cast<float>(exact::exp(-0.5 * square / std::max(sigma_px * sigma_px, 0.36)))});
    }
  return kernel;
}

Grid<glm::vec3> bilateral_filter(const Grid<glm::vec3>& lab, const BilateralKernel& kernel) {
  Grid<glm::vec3> out(lab.width(), lab.height());
  constexpr float narrow = 1.0F / (16.0F * bilateral_tolerance * bilateral_tolerance);
  parallel_rows(lab.height(), [&](int y) {
    for (int x = 0; x < lab.width(); ++x) {
      const glm::vec3 own = lab(x, y);
      glm::vec3 sum{0.0F};
      float total = 0.0F;
      for (const auto& at : kernel.neighbours) {
        const glm::vec3& other = lab.clamped(x + at.x, y + at.y);
        const glm::vec3 apart = other - own;
        // exp(-d²/2t²) approximated by (1 - d²/16t²)^8: cheap, with the same bits on all machines.
        float like = std::max(0.0F, 1.0F - narrow * glm::dot(apart, apart));
        like *= like;
        like *= like;
        like *= like * at.weight;
        sum += like * other;
        total += like;
      }
      out(x, y) = sum / total;
    }
  });
  return out;
}

}  // namespace

double missing_unevenness(const Style& style, const StylePaintParameters& parameters) {
  const double square = style.unevenness * style.unevenness;
  const double own = program_unevenness * program_unevenness;
  return parameters.unevenness *
         std::min(std::sqrt(std::max(0.0, square - own)), max_missing_unevenness);
}

double style_distance(const StylePaintParameters& parameters, double depth_m) {
  const double low = exact::log(parameters.near_m);
  const double high = exact::log(parameters.far_m);
  return unit((exact::log(std::max(depth_m, 1.0)) - low) / (high - low));
}

StyleGround make_style_ground(const Style& style, const GuidanceBuffers& guidance,
                              const Grid<glm::vec3>& render, const Grid<float>& veil,
                              const StylePaintParameters& parameters, glm::ivec2 origin_px) {
  Grid<glm::vec3> lab(render.width(), render.height());
  const Air air(style.palette);
  parallel_ranges(lab.height(), 16, [&](int begin, int end) {
    for (std::size_t i = lab.index(0, begin); i < lab.index(0, end); ++i) {
      lab[i] = glm::vec3(to_oklab(render[i]));
      if (!guidance.is_sky(i)) lab[i] = in_air(lab[i], style, air, parameters, guidance, i);
    }
  });
  const Grid<glm::vec3> before_sky = veil.empty() ? Grid<glm::vec3>() : lab;
  paint_style_sky(lab, style, guidance, parameters, origin_px);
  for (std::size_t i = 0; i < before_sky.size(); ++i)
    lab[i] = glm::mix(lab[i], before_sky[i], veil[i]);
  strengthen_forms(lab, style, guidance, parameters, origin_px);
  StyleGround ground;
  ground.smoothed = bilateral_filter(lab, bilateral_kernel(bilateral_sigma_px(style, parameters)));
  ground.colour = std::move(lab);
  return ground;
}

int style_ground_margin_px(const Style& style, const StylePaintParameters& parameters) {
  return blur_reach_px(contrast_sigma_units * parameters.pixels_per_unit) +
         bilateral_kernel(bilateral_sigma_px(style, parameters)).reach_px;
}

}  // namespace belvedere
