#include "renderer/mist/mist_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

constexpr float dab_spacing = 4.2F;    // units of the sheet, as all lengths here
constexpr float dab_length = 30.F;     // the longest
constexpr float dab_width = 9.F;       // the widest
constexpr float light_spacing = 3.6F;  // of the lights on the crests of heaps
constexpr float look_units = 3.0F;     // distance for the gradient of light
constexpr float thinnest = 0.03F;      // share below which no stroke is placed
constexpr float edge_hand = 0.7F;      // how far edges are drawn by the brush instead of the air
constexpr double reach_units = 0.52 * dab_length + 0.54 * dab_width + look_units + 3.0;

// Inputs of mist strokes.
struct MistCanvas {
  const MistSight& sight;
  const Grid<glm::vec3>& colour;
  const AirParameters& air;
  const Palette& palette;
};

// Change of the light to the right and down over look_units, on the same mist.
glm::vec2 run_of_light(const StrokeScene& scene, const MistSight& sight, glm::vec2 position,
                       std::size_t i) {
  const float reach = look_units * scene.scale();
  const auto there = [&](glm::vec2 step) {
    const glm::vec2 at = position + reach * step;
    if (!scene.on_canvas(at)) return sight.light[i];
    const std::size_t k = scene.pixel(at);
    const float nearness = std::abs(sight.depth_m[k] / sight.depth_m[i] - 1.F);
    return nearness < 0.06F ? sight.light[k] : sight.light[i];
  };
  return {there({1.F, 0.F}) - there({-1.F, 0.F}), there({0.F, 1.F}) - there({0.F, -1.F})};
}

// Dabs follow the heaps, perpendicular to the gradient of light, and are level where there is none.
float ground_jacobian_of(glm::vec2 run) {
  const float strength = glm::length(run);
  if (strength < 0.02F) return 0.F;
  glm::vec2 along(-run.y, 0.75F * run.x);
  if (along.x < 0.F) along = -along;
  const auto angle =
      static_cast<float>(exact::atan2(static_cast<double>(along.y), static_cast<double>(along.x)));
  return angle * smoothstep(0.02F, 0.12F, strength);
}

Stroke mist_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed) {
  Stroke stroke = ground_stroke(scene, i, seed);
  stroke.depth_tolerance = 0.08F;
  return stroke;
}

// A stroke and its share of the background.
struct MistStroke {
  Stroke stroke;
  float share;
};

std::vector<MistStroke> mist_dabs(const StrokeScene& scene, const MistCanvas& canvas) {
  return sow<MistStroke>(
      scene, dab_spacing, Stream::mist_dabs,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<MistStroke>& out) {
        const float share = canvas.sight.share[i];
        if (share < thinnest) return;
        Stroke stroke = mist_stroke(scene, i, seed);
        const glm::vec2 run = run_of_light(scene, canvas.sight, position, i);
        const float modelled = smoothstep(0.02F, 0.20F, glm::length(run));
        const float angle =
            ground_jacobian_of(run) + std::clamp(0.05F * seed.normal(), -0.12F, 0.12F);
        const float length = seed.between(14.F, dab_length) * (1.F - 0.62F * modelled);
        lay_line(stroke, scene, position, length, angle, 0.08F, false, seed);
        const float width = seed.between(5.F, dab_width) * (1.F - 0.40F * modelled);
        take_brush(stroke, scene, width,
                   {.taper = 0.8F,
                    .alpha = 0.34F,
                    .bristle = 0.16F,
                    .wetness = 0.006F,
                    .load = 0.35F,
                    .edge = 0.25F});
        const float jitter = 0.012F * seed.normal();
        stroke.colour = canvas.colour[i] + jitter;
        stroke.order = seed.uniform();
        const float frayed = share + 0.10F * seed.normal() * (1.F - smoothstep(0.75F, 1.F, share));
        out.push_back({stroke, unit(frayed)});
      });
}

// Small lights where the sun falls on the crests of heaps.
std::vector<MistStroke> mist_lights(const StrokeScene& scene, const MistCanvas& canvas) {
  return sow<MistStroke>(
      scene, light_spacing, Stream::mist_lights,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<MistStroke>& out) {
        const float share = canvas.sight.share[i];
        const float light = canvas.sight.light[i];
        const float chance = seed.uniform();
        if (share < 0.6F || chance > smoothstep(0.55F, 0.90F, light)) return;
        Stroke stroke = mist_stroke(scene, i, seed);
        const float angle = ground_jacobian_of(run_of_light(scene, canvas.sight, position, i)) +
                            std::clamp(0.10F * seed.normal(), -0.25F, 0.25F);
        lay_line(stroke, scene, position, seed.between(4.F, 10.F), angle, 0.20F, false, seed);
        take_brush(stroke, scene, seed.between(1.8F, 3.6F),
                   {.taper = 0.7F,
                    .alpha = 0.36F,
                    .bristle = 0.25F,
                    .wetness = 0.008F,
                    .load = 0.4F,
                    .edge = 0.4F});
        stroke.colour = mist_colour(canvas.air, canvas.palette, unit(light + 0.16F),
                                    scene.guidance.depth_m[i], canvas.sight.altitude_m[i]);
        stroke.order = -seed.uniform();
        out.push_back({stroke, share});
      });
}

// Buffers for the painter: mist is its own surface at its own distance.
GuidanceBuffers mist_guidance(const MistSight& sight) {
  GuidanceBuffers guidance;
  guidance.depth_m = sight.depth_m;
  guidance.land_cover =
      Grid<LandCoverClass>(sight.share.width(), sight.share.height(), LandCoverClass::snow);
  return guidance;
}

Grid<glm::vec3> lay(Grid<glm::vec3> canvas, const GuidanceBuffers& guidance,
                    std::vector<Stroke> strokes, const StrokeScene& scene, Progress& progress) {
  Painting painting = begin_painting(std::move(canvas), false);
  paint_in_order(painting, guidance, std::move(strokes), scene.parameters.pixels_per_unit, progress,
                 scene.window);
  return std::move(painting.picture);
}

}  // namespace

glm::vec3 mist_colour(const AirParameters& air, const Palette& palette, float light, double depth_m,
                      double altitude_m) {
  const glm::vec3 deep = 0.94F * glm::mix(palette.haze_near, palette.cloud_shade, 0.40F);
  const std::array<glm::vec3, 4> ramp = {deep, palette.cloud_shade,
                                         glm::mix(palette.cloud_shade, palette.cloud_light, 0.66F),
                                         palette.cloud_light};
  constexpr std::array<float, 4> lights = {0.05F, 0.34F, 0.62F, 0.92F};
  glm::vec3 colour = ramp.front();
  for (std::size_t k = 1; k < ramp.size(); ++k)
    colour = glm::mix(colour, ramp[k], unit((light - lights[k - 1]) / (lights[k] - lights[k - 1])));
  const auto separation = static_cast<float>(air.range_mist);
  const float share =
      air_share(air, palette, depth_m, altitude_m, farness(air, depth_m) * separation, 0.F);
  return glm::mix(colour, air_colour(air, palette, depth_m), unit(share));
}

int mist_margin_px(const StrokeParameters& strokes) {
  return static_cast<int>(std::ceil(reach_units * strokes.pixels_per_unit)) + 4;
}

MistPaint paint_mist(const MistSight& sight, const AirParameters& air, const Palette& palette,
                     const StrokeParameters& strokes, const SheetWindow& window,
                     Progress& progress) {
  const PixelRect asked = window.asked == PixelRect{}
                              ? PixelRect{0, 0, sight.share.width(), sight.share.height()}
                              : window.asked;
  MistPaint paint{part_of(sight.share, asked),
                  Grid<glm::vec3>(asked.width(), asked.height(), glm::vec3(0.F))};
  if (std::all_of(sight.share.begin(), sight.share.end(), [](float share) { return share <= 0.F; }))
    return paint;
  BasePicture base;
  base.colour = Grid<glm::vec3>(sight.share.width(), sight.share.height(), glm::vec3(0.F));
  parallel_rows(base.colour.height(), [&](int y) {
    for (int x = 0; x < base.colour.width(); ++x) {
      const std::size_t i = base.colour.index(x, y);
      if (sight.share[i] > 0.F)
        base.colour[i] =
            mist_colour(air, palette, sight.light[i], sight.depth_m[i], sight.altitude_m[i]);
    }
  });
  const GuidanceBuffers guidance = mist_guidance(sight);
  const StrokeScene scene{guidance, base, strokes, window, mist_margin_px(strokes)};
  const MistCanvas canvas{sight, base.colour, air, palette};
  std::vector<MistStroke> grown = mist_dabs(scene, canvas);
  const std::vector<MistStroke> lights = mist_lights(scene, canvas);
  grown.insert(grown.end(), lights.begin(), lights.end());

  std::vector<Stroke> laid;
  laid.reserve(grown.size());
  for (const MistStroke& one : grown) laid.push_back(one.stroke);
  paint.colour = part_of(lay(base.colour, guidance, laid, scene, progress), asked);
  // The same strokes again, with the hidden share as their paint.
  for (std::size_t k = 0; k < grown.size(); ++k) {
    laid[k].colour = glm::vec3(grown[k].share);
    laid[k].load = 0.F;
    laid[k].wetness = 0.F;
  }
  Grid<glm::vec3> shares(sight.share.width(), sight.share.height());
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = glm::vec3(sight.share[i]);
  const Grid<glm::vec3> drawn =
      part_of(lay(std::move(shares), guidance, std::move(laid), scene, progress), asked);
  for (std::size_t i = 0; i < paint.share.size(); ++i)
    paint.share[i] = unit(paint.share[i] + edge_hand * (drawn[i].x - paint.share[i]));
  return paint;
}

void lay_mist(Grid<glm::vec3>& picture, glm::ivec2 at, const MistPaint& paint) {
  parallel_rows(paint.share.height(), [&](int y) {
    for (int x = 0; x < paint.share.width(); ++x) {
      glm::vec3& pixel = picture(at.x + x, at.y + y);
      pixel = glm::mix(pixel, paint.colour(x, y), paint.share(x, y));
    }
  });
}

}  // namespace belvedere
