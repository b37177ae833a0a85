#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "base/math.h"
#include "base/math_exact.h"
#include "texture/strokes/class_strokes.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float open_units = 4.5F;   // min distance of streaks from a shore: brooks have none
constexpr double patches_m = 420.0;  // of ruffled water, the same as in the base picture
constexpr float usual_m =
    14.F;  // metres per unit of the sheet at which a streak has its standard size
constexpr float sea_within_m = 1.6F;    // tolerance of the sea's level in DEMs
constexpr float widest_surf_m = 120.F;  // max width of surf on the ground, at any distance
constexpr float look_units = 2.5F;      // up and down the water, to measure its slope
constexpr float fall_from = 0.25F;      // ratio of drop to length from which rivers whiten …
constexpr float fall_to = 0.53F;        // … and at which they are white
constexpr int bank_steps =
    5;  // in look_units: max width of a lake's bank where coarse cells extend water uphill
constexpr float level_slope = 0.03F;  // max slope of a lake's surface

// The white of broken water.
glm::vec3 foam_white(const StrokeScene& scene, std::size_t i) {
  const float light = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  return through_air(scene, i,
                     glm::vec3(0.80F, 0.86F, 0.90F) + light * glm::vec3(0.18F, 0.12F, 0.08F));
}

bool is_sea(const StrokeScene& scene, std::size_t i) {
  return scene.class_at(i) == water &&
         std::abs(scene.altitude_m(i) - static_cast<float>(scene.parameters.sea_level_m)) <
             sea_within_m;
}

// Sum of the directions towards the shore, and whether there is one. Nearer ground in front of the
// water is not a shore.
struct Shore {
  glm::vec2 towards{0.F};
  bool found = false;
};
Shore shore_around(const StrokeScene& scene, glm::vec2 position, std::size_t i,
                   float radius_units) {
  constexpr float s = 0.7071F;
  constexpr glm::vec2 directions[8] = {{1.F, 0.F},  {s, s},   {0.F, 1.F},  {-s, s},
                                       {-1.F, 0.F}, {-s, -s}, {0.F, -1.F}, {s, -s}};
  Shore shore;
  for (const glm::vec2 direction : directions) {
    const glm::vec2 there = position + direction * (radius_units * scene.scale());
    if (!scene.on_canvas(there)) continue;
    const std::size_t k = scene.pixel(there);
    if (scene.guidance.is_sky(k) || scene.class_at(k) == water || !on_same_slope(scene, i, k))
      continue;
    shore.towards += direction;
    shore.found = true;
  }
  return shore;
}

// The ground position where the water of one position continues at another; nothing if that is not
// water, or on another slope.
std::optional<glm::vec3> water_at(const StrokeScene& scene, std::size_t i, glm::vec2 there) {
  if (!scene.on_canvas(there)) return std::nullopt;
  const std::size_t k = scene.pixel(there);
  if (scene.class_at(k) != water || !on_same_slope(scene, i, k)) return std::nullopt;
  return scene.guidance.position_m[k];
}

// Drop divided by length.
float slope_of(glm::vec3 way) { return way.z / std::max(glm::length(glm::vec2(way)), 1.F); }

// Whether water lies on the bank of a lake rather than falling: down the slope it soon becomes
// level and broad.
bool is_bank(const StrokeScene& scene, glm::vec2 position, std::size_t i) {
  const glm::vec2 step = scene.fall_line(position) * (look_units * scene.scale());
  const glm::vec2 aside = 0.6F * glm::vec2(-step.y, step.x);
  const auto is_wet = [&](glm::vec2 there) {
    return !scene.on_canvas(there) || water_at(scene, i, there);
  };
  glm::vec3 before = scene.guidance.position_m[i];
  for (int k = 1; k <= bank_steps; ++k) {
    const glm::vec2 there = position + static_cast<float>(k) * step;
    const std::optional<glm::vec3> here = water_at(scene, i, there);
    if (!here) return false;
    if (std::abs(slope_of(before - *here)) < level_slope && is_wet(there + aside) &&
        is_wet(there - aside))
      return true;
    before = *here;
  }
  return false;
}

// How water falls at a position: ratio of drop to length in the steepest direction, and that
// direction on the sheet. 0 at its ends and on lakes, whatever their banks.
struct WaterFall {
  float slope = 0.F;
  glm::vec2 down{0.F, 1.F};
};
WaterFall fall_of_water(const StrokeScene& scene, glm::vec2 position, std::size_t i) {
  const glm::vec2 down = scene.fall_line(position);
  const glm::vec2 step = down * (look_units * scene.scale());
  const std::optional<glm::vec3> above = water_at(scene, i, position - step);
  const std::optional<glm::vec3> below = water_at(scene, i, position + step);
  if (above && below) return {slope_of(*above - *below), down};
  // The edge of broad water.
  const glm::vec3 here = scene.guidance.position_m[i];
  if (below && water_at(scene, i, position + 2.F * step)) return {slope_of(here - *below), down};
  if (above && water_at(scene, i, position - 2.F * step)) return {slope_of(*above - here), down};
  // A brook is narrow and does not follow the fall line of the wall it falls over: the direction is
  // found from the water itself, along eight axes.
  constexpr glm::vec2 axes[8] = {{1.F, 0.F},          {0.9239F, 0.3827F}, {0.7071F, 0.7071F},
                                 {0.3827F, 0.9239F},  {0.F, 1.F},         {-0.3827F, 0.9239F},
                                 {-0.7071F, 0.7071F}, {-0.9239F, 0.3827F}};
  WaterFall fall;
  for (const glm::vec2 axis : axes) {
    const glm::vec2 along = axis * (look_units * scene.scale());
    const std::optional<glm::vec3> a = water_at(scene, i, position - along);
    const std::optional<glm::vec3> b = water_at(scene, i, position + along);
    if (!a || !b) continue;
    const float slope = slope_of(*a - *b);
    if (std::abs(slope) > fall.slope) fall = {std::abs(slope), slope > 0.F ? axis : -axis};
  }
  return fall;
}

}  // namespace

std::vector<Stroke> wind_streaks(const StrokeScene& scene, Stream stream) {
  const auto wind = static_cast<float>(scene.parameters.wind);
  if (!(wind > 0.F)) return {};
  return sow(scene, 3.6F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.class_at(i) != water || is_frozen(scene, i)) return;
               // Along the borders of ruffled patches, where they are stretched by the wind.
               const float patch = ground_noise(scene, i, Stream::water_wind, patches_m);
               const float gathers =
                   smoothstep(-0.2F, 0.7F, patch) * (1.F - 0.6F * smoothstep(1.2F, 2.F, patch));
               if (seed.uniform() > 0.36F * wind * gathers) return;
               if (share_around(scene, position, open_units,
                                [&](std::size_t k) { return scene.class_at(k) == water; }) < 1.F)
                 return;
               Stroke stroke = ground_stroke(scene, i, seed);
               stroke.gate = StrokeGate::water;
               lay_on_top(stroke);
               // Shorter and thinner with distance, but not smaller than a brush can draw.
               const float size = std::clamp(
                   std::sqrt(usual_m / std::max(scene.metres_per_unit(i), 0.1F)), 0.35F, 1.3F);
               const float angle = 0.012F * seed.normal();
               const float length = size * seed.between(8.F, 24.F);
               lay_line(stroke, scene, position, length, angle, 0.015F, false, seed);
               take_brush(stroke, scene, std::max(size * seed.between(0.45F, 1.05F), 0.35F),
                          {.taper = 0.25F,
                           .alpha = 0.42F,
                           .bristle = 0.35F,
                           .wetness = 0.01F,
                           .load = 0.4F,
                           .edge = 0.3F});
               const float light = seed.between(0.5F, 1.1F);
               stroke.colour = glm::mix(scene.colour(i, light, 0.4F * paint_jitter, seed),
                                        foam_white(scene, i), 0.22F);
               out.push_back(stroke);
             });
}

std::vector<Stroke> river_foam(const StrokeScene& scene, Stream stream) {
  if (!scene.parameters.foam || scene.parameters.winter) return {};
  return sow(
      scene, 1.0F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        if (scene.class_at(i) != water) return;
        const WaterFall fall = fall_of_water(scene, position, i);
        const float steep = smoothstep(fall_from, fall_to, fall.slope);
        if (seed.uniform() > 0.85F * steep || is_bank(scene, position, i)) return;
        Stroke stroke = ground_stroke(scene, i, seed);
        stroke.gate = StrokeGate::water;
        lay_on_top(stroke);
        const auto down = static_cast<float>(
            exact::atan2(static_cast<double>(fall.down.y), static_cast<double>(fall.down.x)));
        const float length = seed.between(1.8F, 4.6F);
        lay_line(stroke, scene, position, length, down + 0.1F * seed.normal(), 0.08F, false, seed);
        take_brush(stroke, scene, seed.between(0.5F, 1.1F),
                   {.taper = 0.6F, .alpha = 0.8F, .bristle = 0.35F, .wetness = 0.01F});
        stroke.colour = foam_white(scene, i);
        out.push_back(stroke);
      });
}

std::vector<Stroke> sea_surf(const StrokeScene& scene, Stream stream) {
  const auto asked = static_cast<float>(scene.parameters.surf_units);
  if (!(asked > 0.F)) return {};
  return sow(scene, 1.4F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (!is_sea(scene, i)) return;
               const float width =
                   std::min(asked, widest_surf_m / std::max(scene.metres_per_unit(i), 0.1F));
               const Shore shore = shore_around(scene, position, i, 1.1F * width + 0.5F);
               const float reach = glm::length(shore.towards);
               if (!shore.found || reach < 0.5F) return;
               if (sheet_noise(scene, position, Stream::surf_breaks, 7.0) < -0.35F ||
                   seed.uniform() < 0.15F)
                 return;
               Stroke stroke = ground_stroke(scene, i, seed);
               stroke.gate = StrokeGate::water;
               lay_on_top(stroke);
               const glm::vec2 along = glm::vec2(-shore.towards.y, shore.towards.x) / reach;
               const glm::vec2 half = along * (0.5F * scene.scale() * seed.between(1.6F, 4.2F));
               const float thick = scene.scale() * width * seed.between(0.45F, 0.8F);
               set_line(stroke, position - half, position + half, thick, 0.5F * thick);
               stroke.alpha = 0.72F;
               stroke.colour = foam_white(scene, i);
               out.push_back(stroke);
             });
}

}  // namespace belvedere
