#include "renderer/paint/water/water_image.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/sky.h"

namespace belvedere {
namespace {

constexpr double water_index = 1.333;  // of refraction, at 20 °C
constexpr double painters_power = 0.4;
constexpr float land_share = 1.5F;  // how much stronger the image of land is than the sky's …
constexpr float max_mirrored_share = 0.88F;  // … up to this limit
constexpr double wave_slope_rad = 0.06;      // deviation of the angle by which waves turn rays
constexpr double longest_units = 9.0;        // max deviation of the stretch of images …
constexpr double shortest_units = 0.45;      // … and min
constexpr double reach_sigmas = 2.0;         // extent of the Gaussian kernel
constexpr int looks = 12;                    // samples up and down, each
constexpr double zenith_rise =
    0.80;  // sine of the elevation from which the sky has the colour of the picture's top
constexpr glm::vec3 sky_in_water{0.80F, 0.88F, 0.93F};
constexpr glm::vec3 in_water{0.66F, 0.76F,
                             0.86F};  // reflections are darker and bluer than their source
constexpr float wrap = 0.22F;         // as ToneParameters::wrap
constexpr float seen_sky = 0.85F;     // share of the sky that open slopes see, to its power of 1.3

// Light on a reflected position: of the large forms only, because waves hide the rest.
double tone_of(const MirrorSight& s, std::size_t i, const WaterImageParameters& p) {
  const glm::vec3 normal = s.normal[i];
  const float towards = glm::dot(normal, glm::vec3(p.sun_direction));
  const float facing = std::clamp((towards + wrap) / (1.0F + wrap), 0.0F, 1.0F);
  const double sun =
      p.light.sun * static_cast<double>(facing * (1.0F - static_cast<float>(p.light.shadow_depth) *
                                                             (1.0F - s.shadow[i])));
  const double sky = p.light.sky * static_cast<double>(seen_sky * (0.6F + 0.4F * normal.z));
  const ClassTone& tone = class_info(s.land_cover[i]).tone;
  const double value =
      (sun + sky - static_cast<double>(raw_black)) / static_cast<double>(raw_range) +
      static_cast<double>(tone.lift);
  return std::clamp(
      middle_tone + (value - middle_tone) * static_cast<double>(tone.contrast) * p.light.contrast,
      0.0, 1.0);
}

// The result of one mirrored ray.
struct MirrorRay {
  glm::vec3 colour{0.0F};
  float share = 0.0F;
  float land = 0.0F;
  glm::vec3 sky{0.0F};
};

MirrorRay image_at(const MirrorSight& s, std::size_t i, float altitude_m, const Palette& palette,
                   const WaterImageParameters& p) {
  MirrorRay image;
  const double mirrored = painted_mirror(static_cast<double>(s.cosine[i])) * p.strength;
  image.sky = sky_gradient(palette, 1.0 - unit(static_cast<double>(s.rise[i]) / zenith_rise)) *
              sky_in_water;
  image.colour = image.sky;
  image.share = static_cast<float>(std::min(mirrored, static_cast<double>(max_mirrored_share)));
  if (std::isinf(s.path_m[i])) return image;
  image.land = 1.0F;
  image.share = std::min(land_share * static_cast<float>(mirrored), max_mirrored_share);
  image.colour =
      palette_colour(palette, s.land_cover[i], s.altitude_m[i], tone_of(s, i, p)) * in_water;
  // Air along the whole path; the part up to the water is applied later to everything.
  const double before_m = s.distance_m[i];
  const double whole_m = before_m + static_cast<double>(s.path_m[i]);
  const float before = air_share(p.air, palette, before_m, altitude_m, 0.0F, 0.0F);
  const float whole = air_share(p.air, palette, whole_m, altitude_m, 0.0F, 0.0F);
  const float beyond =
      before < 1.0F ? std::clamp((whole - before) / (1.0F - before), 0.0F, 1.0F) : 0.0F;
  image.colour = glm::mix(image.colour, air_colour(p.air, palette, whole_m), beyond);
  return image;
}

// Deviation of a stretched image, px: waves turn the ray, so what is farther from the water shifts
// more.
double drawn_px(float distance_m, float path_m, float footprint_m, const WaterImageParameters& p) {
  const double share =
      std::isinf(path_m) ? 1.0 : static_cast<double>(path_m / (path_m + distance_m));
  const double pixels_per_rad =
      footprint_m > 0.0F ? static_cast<double>(distance_m / footprint_m) : 0.0;
  return std::clamp(wave_slope_rad * share * pixels_per_rad, shortest_units * p.pixels_per_unit,
                    longest_units * p.pixels_per_unit);
}

}  // namespace

double water_fresnel(double cosine) {
  const double c = unit(cosine);
  const double sine = std::sqrt(std::max(0.0, 1.0 - c * c)) / water_index;
  const double below = std::sqrt(1.0 - sine * sine);
  const double across = (c - water_index * below) / (c + water_index * below);
  const double along = (water_index * c - below) / (water_index * c + below);
  return 0.5 * (across * across + along * along);
}

double painted_mirror(double cosine) { return exact::pow(water_fresnel(cosine), painters_power); }

WaterImage paint_water_image(const MirrorSight& sight, PixelRect rect,
                             const GuidanceBuffers& guidance, const Palette& palette,
                             const WaterImageParameters& p, PixelRect wanted) {
  if (sight.width() != rect.width() || sight.height() != rect.height() ||
      intersection(rect, wanted) != wanted)
    throw Error(ErrorKind::bug, "images in water",
                "the mirrored rays cover other pixels than the image");
  const auto is_water = [&](int x, int y) {
    return guidance.land_cover(rect.x0 + x, rect.y0 + y) == LandCoverClass::water &&
           sight.cosine(x, y) > 0.0F;
  };
  Grid<MirrorRay> images(rect.width(), rect.height());
  parallel_rows(rect.height(), [&](int y) {
    for (int x = 0; x < rect.width(); ++x)
      if (is_water(x, y))
        images(x, y) = image_at(sight, sight.cosine.index(x, y),
                                guidance.altitude_m(rect.x0 + x, rect.y0 + y), palette, p);
  });
  WaterImage out{Grid<glm::vec3>(wanted.width(), wanted.height(), glm::vec3(0.0F)),
                 Grid<float>(wanted.width(), wanted.height(), 0.0F),
                 Grid<float>(wanted.width(), wanted.height(), 0.0F),
                 Grid<glm::vec3>(wanted.width(), wanted.height(), glm::vec3(0.0F))};
  parallel_rows(wanted.height(), [&](int row) {
    const int y = wanted.y0 - rect.y0 + row;
    for (int column = 0; column < wanted.width(); ++column) {
      const int x = wanted.x0 - rect.x0 + column;
      if (!is_water(x, y)) continue;
      const std::size_t i = sight.cosine.index(x, y);
      const double sigma = drawn_px(sight.distance_m[i], sight.path_m[i],
                                    guidance.footprint_m(rect.x0 + x, rect.y0 + y), p);
      MirrorRay sum;
      float weights = 0.0F;
      int before = 0;
      for (int k = -looks; k <= looks; ++k) {
        // Rounded positions: where a unit has few pixels several samples fall on one pixel, which
        // is read once.
        const int step = static_cast<int>(std::lround(reach_sigmas * sigma * k / looks));
        if (k > -looks && step == before) continue;
        before = step;
        const double t = std::min(std::abs(step) / (reach_sigmas * sigma), 1.0);
        if (!images.contains(x, y + step) || !is_water(x, y + step) ||
            !same_surface(sight.distance_m(x, y + step), sight.distance_m[i]))
          continue;
        const auto weight = static_cast<float>(square(1.0 - t * t));
        const float w = std::max(weight, 1e-3F);
        const MirrorRay& image = images(x, y + step);
        sum.colour += w * image.share * image.colour;
        sum.share += w * image.share;
        sum.land += w * image.share * image.land;
        weights += w;
      }
      const std::size_t o = out.share.index(column, row);
      out.sky[o] = images[i].sky;
      out.share[o] = sum.share / weights;
      if (sum.share > 0.0F) {
        out.colour[o] = sum.colour / sum.share;
        out.land[o] = sum.land / sum.share;
      }
    }
  });
  return out;
}

int water_image_margin_px(double pixels_per_unit) {
  return static_cast<int>(std::ceil(reach_sigmas * longest_units * pixels_per_unit)) + 1;
}

namespace {

constexpr double reflection_units = 34.0;  // reach of the shore's image into the water
constexpr float fade_units = 22.0F;        // distance over which it fades
constexpr double meadow_units =
    30.0;  // width of level shore beyond which the slope behind is still reflected …
constexpr float meadow_half_units = 14.0F;  // … at half strength from here
constexpr float level_deg = 8.0F;           // flatter shores have no image
constexpr float foreshortening =
    1.25F;  // seen from above, the image of a slope is shorter than the slope

bool is_water(const GuidanceBuffers& g, int x, int y) {
  return g.land_cover(x, y) == LandCoverClass::water;
}

}  // namespace

Mirrored find_reflections(const GuidanceBuffers& guidance, double pixels_per_unit,
                          PixelRect wanted) {
  require_channels(
      guidance,
      {&GuidanceBuffers::depth_m, &GuidanceBuffers::land_cover, &GuidanceBuffers::slope_deg},
      "reflections");
  const int width = guidance.width();
  const int height = guidance.height();
  if (wanted.empty()) wanted = {0, 0, width, height};
  const int reach_px = static_cast<int>(std::ceil(reflection_units * pixels_per_unit));
  const int meadow_px = static_cast<int>(std::ceil(meadow_units * pixels_per_unit));
  const auto ppu = static_cast<float>(pixels_per_unit);
  const auto is_level = [&](int x, int y) { return guidance.slope_deg(x, y) < level_deg; };
  Mirrored mirrored{Grid<std::int32_t>(width, height, -1), Grid<float>(width, height, 0.0F),
                    Grid<float>(width, height, open_water), Grid<float>(width, height, open_water)};
  parallel_rows(wanted.height(), [&](int row) {
    const int y = wanted.y0 + row;
    for (int x = wanted.x0; x < wanted.x1; ++x) {
      if (!is_water(guidance, x, y)) continue;
      int below = 1;
      while (below <= reach_px && y + below < height && is_water(guidance, x, y + below)) ++below;
      if (below <= reach_px && y + below < height &&
          same_surface(guidance.depth_m(x, y), guidance.depth_m(x, y + below)))
        mirrored.to_near(x, y) = static_cast<float>(below) / ppu;
      int above = 1;
      while (above <= reach_px && y - above >= 0 && is_water(guidance, x, y - above)) ++above;
      const int shore = y - above;
      // A silhouette in front of the water is not a shore: it is nearer than the water.
      if (above > reach_px || shore < 0 ||
          !same_surface(guidance.depth_m(x, y), guidance.depth_m(x, shore)))
        continue;
      mirrored.to_far(x, y) = static_cast<float>(above) / ppu;
      // A level meadow has no image: the slope behind it is reflected.
      int foot = shore;
      while (shore - foot < meadow_px && foot > 0 && is_level(x, foot) &&
             !is_water(guidance, x, foot) &&
             same_surface(guidance.depth_m(x, foot), guidance.depth_m(x, foot - 1)))
        --foot;
      if (is_level(x, foot) || is_water(guidance, x, foot)) continue;
      const int mirrored_row = std::max(
          foot - static_cast<int>(std::lround(foreshortening * static_cast<float>(above))), 0);
      int top = foot;
      while (top > mirrored_row && !is_water(guidance, x, top - 1) &&
             same_surface(guidance.depth_m(x, top), guidance.depth_m(x, top - 1)))
        --top;
      mirrored.source(x, y) = static_cast<std::int32_t>(guidance.depth_m.index(x, top));
      // Steep shores have dark images, level ones hardly any: the image of a meadow is only a line.
      const float into_units = static_cast<float>(above / pixels_per_unit);
      const float cut_short =
          top > mirrored_row ? std::max(0.0F, 1.0F - static_cast<float>(top - mirrored_row) /
                                                         static_cast<float>(pixels_per_unit) / 6.0F)
                             : 1.0F;
      mirrored.share(x, y) = std::max(0.0F, 1.0F - into_units / fade_units) * cut_short /
                             (1.0F + static_cast<float>(shore - foot) / ppu / meadow_half_units);
    }
  });
  return mirrored;
}

int reflection_margin_px(double pixels_per_unit) {
  const int reach_px = static_cast<int>(std::ceil(reflection_units * pixels_per_unit));
  const int meadow_px = static_cast<int>(std::ceil(meadow_units * pixels_per_unit));
  return reach_px + meadow_px +
         static_cast<int>(std::ceil(foreshortening * static_cast<float>(reach_px))) + 1;
}

}  // namespace belvedere
