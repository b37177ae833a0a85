#include "renderer/style/style_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random_streams.h"
#include "renderer/image/oklab.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/style/style_sky.h"

namespace belvedere {
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
