#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

#include "texture/strokes/class_strokes.h"
#include "texture/strokes/stroke_parts.h"

// Ground detail for close views only: single stones and tufts of grass. The number of stones and
// tufts larger than d metres per square metre is k / d², as for rock fragments; so every view has
// the same density on the sheet of those just large enough to draw, until even the largest ones are
// too small.
namespace belvedere {
namespace {

using enum LandCoverClass;

struct Sizes {
  float per_m2 = 0.F;      // k: number larger than 1 m per square metre
  float largest_m = 2.F;   // natural limit
  float min_units = 1.8F;  // of the sheet: smaller ones are part of the grain
};
constexpr float max_units = 9.F;  // larger ones would need more than a dab
constexpr float spacing_units = 3.F;
constexpr int max_in_cell = 4;

// Square metres of ground in plan per square unit of the sheet at a pixel: from the positions of
// its neighbours on the same surface.
std::optional<float> ground_m2_per_unit2(const StrokeScene& scene, glm::vec2 position,
                                         std::size_t i) {
  const auto& g = scene.guidance;
  const auto step = [&](glm::vec2 to) -> std::optional<glm::dvec2> {
    for (const float side :
         {1.F, -1.F}) {  // the last pixel of the sheet has a neighbour on one side only
      const glm::vec2 there = position + side * to;
      if (!scene.on_canvas(there)) continue;
      const std::size_t k = scene.pixel(there);
      if (g.is_sky(k) || std::abs(g.depth_m[k] - g.depth_m[i]) > 0.03F * g.depth_m[i])
        return std::nullopt;
      const glm::dvec3 way = glm::dvec3(g.position_m[k]) - glm::dvec3(g.position_m[i]);
      return glm::dvec2(way.x, way.y);
    }
    return std::nullopt;
  };
  const auto right = step({1.F, 0.F});
  const auto down = step({0.F, 1.F});
  if (!right || !down) return std::nullopt;
  const double px2 = std::abs(right->x * down->y - right->y * down->x);
  return static_cast<float>(px2) * scene.scale() * scene.scale();
}

// An object that lies or stands on the ground.
struct Thing {
  glm::vec2 position{0.F};
  std::size_t pixel = 0;
  float units = 1.F;  // its size on the sheet
};

// Objects of these sizes at a seed: as many as the ground around it holds, each with its own size.
template <class Put>
void strew(const StrokeScene& scene, const Sizes& sizes, StrokeSeed& seed, glm::vec2 position,
           std::size_t i, Put&& put) {
  const float metres = scene.metres_per_unit(i);
  const float min_m = sizes.min_units * metres;
  const float largest_m = std::min(sizes.largest_m, max_units * metres);
  if (!(metres > 0.F) || !(min_m < largest_m) || !(sizes.per_m2 > 0.F)) return;
  const std::optional<float> m2 = ground_m2_per_unit2(scene, position, i);
  if (!m2) return;
  const float min = 1.F / (min_m * min_m);
  const float largest = 1.F / (largest_m * largest_m);
  const float expected = sizes.per_m2 * (min - largest) * *m2 * spacing_units * spacing_units;
  const int count = std::min(max_in_cell, static_cast<int>(expected + seed.uniform()));
  for (int k = 0; k < count; ++k) {
    const float u = seed.uniform();
    Thing thing{position, i, 1.F / (std::sqrt(largest + u * (min - largest)) * metres)};
    const float aside = seed.between(-0.5F, 0.5F) * spacing_units * scene.scale();
    const float along = seed.between(-0.5F, 0.5F) * spacing_units * scene.scale();
    if (k > 0) thing.position += glm::vec2(aside, along);
    if (scene.on_canvas(thing.position)) {
      thing.pixel = scene.pixel(thing.position);
      if (scene.class_at(thing.pixel) == scene.class_at(i)) put(thing);
    }
  }
}

float stones_per_m2(LandCoverClass id) {
  switch (id) {
    case scree:
      return 0.05F;
    case alpine_grass:
      return 0.006F;
    case pasture:
    case shrub:
      return 0.0015F;
    case sand:
      return 0.001F;
    default:
      return 0.F;
  }
}

float tufts_per_m2(LandCoverClass id) {
  switch (id) {
    case alpine_grass:
      return 0.05F;
    case pasture:
      return 0.03F;
    case shrub:
      return 0.06F;
    case scree:
      return 0.003F;
    default:
      return 0.F;
  }
}

// A part of an object: slightly in front of the ground behind it, later parts over earlier ones.
Stroke part_of_thing(const StrokeScene& scene, const Thing& thing, int part) {
  Stroke stroke = standing_stroke(scene, thing.pixel);
  stroke.gate = StrokeGate::upright;
  lay_on_top(stroke);
  stroke.order -= 1e-5F * stroke.depth_m * static_cast<float>(part);
  return stroke;
}

// A stone: its shadow on the ground, away from the sun; its body; the edge facing the sun.
void lay_stone(const StrokeScene& scene, const Thing& stone, StrokeSeed& seed,
               std::vector<Stroke>& out) {
  const float size = stone.units * scene.scale();  // px
  const float clear = 1.F - std::clamp(scene.base.haze[stone.pixel], 0.F, 1.F);
  const float lit = std::clamp(scene.guidance.tone[stone.pixel], 0.F, 1.F);
  const float sun = scene.sun_side(stone.pixel);
  const float flat = seed.between(0.5F, 0.8F);
  const float lean = seed.between(-0.15F, 0.15F) * size;
  Stroke shadow = part_of_thing(scene, stone, 0);
  const glm::vec2 foot = stone.position + glm::vec2(-0.22F * sun * size, 0.16F * size);
  set_line(shadow, foot - glm::vec2(0.42F * size, 0.F), foot + glm::vec2(0.42F * size, 0.F),
           0.42F * size, 0.3F * size);
  shadow.alpha = 0.35F + 0.35F * lit;
  shadow.colour = scene.colour(stone.pixel, -1.4F, paint_jitter, seed) -
                  clear * lit * glm::vec3(0.05F, 0.04F, 0.01F);
  Stroke body = part_of_thing(scene, stone, 1);
  set_line(body, stone.position + glm::vec2(-0.32F * size, 0.08F * size),
           stone.position + glm::vec2(0.32F * size, lean), flat * size, 0.85F * flat * size);
  body.alpha = 0.85F;
  const float grey = seed.normal();
  body.colour = scene.colour(stone.pixel, -0.2F + 0.3F * grey, paint_jitter, seed);
  const float value = (body.colour.r + body.colour.g + body.colour.b) / 3.F;
  body.colour = glm::mix(body.colour, value * glm::vec3(1.02F, 1.F, 1.F),
                         0.6F);  // rock, whatever class it lies in
  out.push_back(shadow);
  out.push_back(body);
  if (stone.units < 1.4F) return;
  Stroke edge = part_of_thing(scene, stone, 2);
  const glm::vec2 top = stone.position + glm::vec2(0.12F * sun * size, -0.24F * flat * size);
  set_line(edge, top - glm::vec2(0.26F * size, 0.F), top + glm::vec2(0.26F * size, 0.5F * lean),
           0.3F * flat * size, 0.2F * flat * size);
  edge.alpha = 0.5F + 0.3F * lit;
  edge.colour = body.colour + clear * (0.05F + 0.13F * lit) * glm::vec3(1.F, 0.92F, 0.78F);
  out.push_back(edge);
}

// Blocks larger than life, as painters place them: at the foot of debris, where the largest come to
// rest, and on the grass below it. The size of one at a seed; nothing where there is none.
std::optional<float> block_units(const StrokeScene& scene, StrokeSeed& seed, glm::vec2 position,
                                 std::size_t i) {
  const LandCoverClass id = scene.class_at(i);
  // Nearer by, stones have their own size.
  constexpr float nearest_m = 1.4F;
  if (scene.parameters.winter || scene.metres_per_unit(i) < nearest_m ||
      (id != scree && !is_grass(id)) || is_floor(id))
    return {};
  const float chance = seed.uniform();
  const float u = seed.uniform();
  if (!is_close(scene, i, seed)) return {};
  const glm::vec2 fall = scene.fall_line(position);
  const auto class_along = [&](float units) {
    const glm::vec2 there = position + fall * (units * scene.scale());
    if (!scene.on_canvas(there)) return id;
    const std::size_t k = scene.pixel(there);
    return on_same_slope(scene, i, k) ? scene.class_at(k) : id;
  };
  float gathered = 0.F;
  if (id == scree) {
    for (const float below : {5.F, 10.F, 16.F})
      if (is_grass(class_along(below))) gathered = std::max(gathered, 1.F - 0.04F * below);
  } else {
    for (const float above : {-4.F, -9.F, -16.F})
      if (class_along(above) == scree) gathered = std::max(gathered, 0.7F + 0.03F * above);
  }
  const float field = sheet_noise(scene, position, Stream::stone_fields, 11.0);
  const float strewn =
      gathered * std::clamp(0.6F + 0.5F * field, 0.F, 1.F) + 0.12F * std::max(0.F, field - 1.2F);
  const float share = id == scree ? 0.012F + 0.30F * strewn : 0.001F + 0.18F * strewn;
  if (chance > share) return {};
  return 1.1F + (1.2F + 2.0F * gathered) * u * u * u;
}

}  // namespace

std::vector<Stroke> ground_stones(const StrokeScene& scene, Stream stream) {
  return sow(scene, spacing_units, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               const float per_m2 = stones_per_m2(scene.class_at(i));
               if (per_m2 <= 0.F) return;
               if (const auto units = block_units(scene, seed, position, i)) {
                 lay_stone(scene, {position, i, *units}, seed, out);
                 return;
               }
               // Fields of stones with bare ground between.
               const float field = std::clamp(
                   1.F + 0.8F * ground_noise(scene, i, Stream::stone_fields, 14.0), 0.05F, 3.F);
               strew(scene, {.per_m2 = per_m2 * field, .largest_m = 2.5F}, seed, position, i,
                     [&](const Thing& stone) { lay_stone(scene, stone, seed, out); });
             });
}

std::vector<Stroke> grass_tufts(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, spacing_units, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const float per_m2 = tufts_per_m2(scene.class_at(i));
        if (per_m2 <= 0.F) return;
        const float lush =
            std::clamp(1.F + 0.8F * ground_noise(scene, i, Stream::tuft_fields, 9.0), 0.1F, 3.F);
        strew(scene, {.per_m2 = per_m2 * lush, .largest_m = 1.2F, .min_units = 2.2F}, seed,
              position, i, [&](const Thing& tuft) {
                const float size = tuft.units * scene.scale();
                const float lit = std::clamp(scene.guidance.tone[tuft.pixel], 0.F, 1.F);
                const float clear = 1.F - std::clamp(scene.base.haze[tuft.pixel], 0.F, 1.F);
                const float wind = seed.between(-0.2F, 0.3F);
                constexpr int blades = 4;
                for (int b = 0; b < blades; ++b) {
                  Stroke blade = part_of_thing(scene, tuft, b);
                  const float spread = (static_cast<float>(b) - 1.5F) / 1.5F;
                  const float height = size * seed.between(0.7F, 1.1F);
                  const glm::vec2 root = tuft.position + glm::vec2(0.18F * spread * size, 0.F);
                  set_line(blade, root, root + glm::vec2((0.35F * spread + wind) * height, -height),
                           0.26F * size, 0.1F * size);
                  blade.alpha = 0.75F;
                  // Dark at the back, light on the side facing the sun.
                  const float light = spread * scene.sun_side(tuft.pixel);
                  blade.colour = scene.colour(tuft.pixel, b % 2 == 0 ? -0.9F : 0.5F * light,
                                              paint_jitter * 1.3F, seed);
                  if (b % 2 != 0) blade.colour += clear * lit * glm::vec3(0.05F, 0.045F, -0.01F);
                  out.push_back(blade);
                }
              });
      });
}

}  // namespace belvedere
