#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/random_streams.h"
#include "texture/strokes/class_strokes.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// What the kinds of stroke share: how a brush is loaded, and what a painter sees around the place he paints.
inline constexpr float paint_jitter = 0.018F;  // deviation of a stroke's colour, encoded sRGB
inline constexpr float quarter_turn = 1.57F;   // rad
inline constexpr float tight_depth = 0.014F;   // rock, snow and scree must not smear across the smallest ridge

// How the brush of one kind of stroke is loaded and drawn out.
struct Brush {
  float taper = 1.F;  // width at the end / at the start
  float alpha = 1.F;
  float bristle = 0.F;
  float wetness = 0.F;
  float load = 1.F;   // 0…1: how much loads of paint differ
  float edge = 0.8F;  // how much paint gathers on one side: on which is drawn by lot
};
void take_brush(Stroke& stroke, const StrokeScene& scene, float width_units, const Brush& brush);

// A stroke that grows from pixel i, with what all of them share.
Stroke ground_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed);
// A stroke of what stands on pixel i. All its parts are of one load of paint: their hairs are seeded by the pixel.
Stroke standing_stroke(const StrokeScene& scene, std::size_t i);
// A straight tapered stroke of the brush between two places, px.
void set_line(Stroke& stroke, glm::vec2 from, glm::vec2 to, float start_width, float end_width);
// Paint seen through the air in front of pixel i: `paint` and the picture's colour mixed by the haze.
glm::vec3 through_air(const StrokeScene& scene, std::size_t i, glm::vec3 paint);
// The same for a factor on the picture's colour.
glm::vec3 through_air_factor(const StrokeScene& scene, std::size_t i, glm::vec3 factor);
// Fresh snow at a tone: white in the sun, blue in the shade.
glm::vec3 fresh_snow(float tone);
// Painted after everything else on its own surface, but before what is nearer: what lies on top of long strokes.
void lay_on_top(Stroke& stroke);

inline bool is_floor(LandCoverClass id) { return has_trait(id, ClassTrait::level); }
inline bool is_ice(LandCoverClass id) { return has_trait(id, ClassTrait::icy); }
inline bool is_grass(LandCoverClass id) { return strokes_of(id).meadow_length > 0.F; }

// Share, 0…1, of eight places on a circle around that satisfy `test(pixel index)`; places off the canvas count as the centre does.
template <class Test>
float share_around(const StrokeScene& scene, glm::vec2 place, float radius_units, Test&& test) {
  // Directions as numbers, so that no machine's sine moves a pixel.
  constexpr float s = 0.7071F;
  constexpr glm::vec2 directions[8] = {{1.F, 0.F}, {s, s}, {0.F, 1.F}, {-s, s}, {-1.F, 0.F}, {-s, -s}, {0.F, -1.F}, {s, -s}};
  const float radius = radius_units * scene.scale();
  int hits = 0;
  for (const glm::vec2 direction : directions) {
    const glm::vec2 there = place + direction * radius;
    hits += test(scene.pixel(scene.on_canvas(there) ? there : place)) ? 1 : 0;
  }
  return static_cast<float>(hits) / 8.F;
}

// Whether water lies so high that it is ice.
inline bool is_frozen(const StrokeScene& scene, std::size_t i) {
  return static_cast<double>(scene.altitude_m(i)) >= scene.parameters.frozen_from_m;
}

// Whether two pixels show the same slope, as far as what stands on it asks.
inline bool on_same_slope(const StrokeScene& scene, std::size_t here, std::size_t there) {
  return std::abs(scene.guidance.depth_m[there] / scene.guidance.depth_m[here] - 1.F) <= 0.03F;
}
// How much the hand has to say around a place of the sheet, 0 it rests … 1 it is busy: places of rest lie beside places of detail, on the
// ground of every kind alike.
float hand_busy_at(const StrokeScene& scene, glm::vec2 place);

// Whether grass grows at pixel i: on meadows of every kind, and in the glades of forests.
bool is_grassy(const StrokeScene& scene, std::size_t i);

// Noise of deviation 1 on the ground, patches of sigma_m; a pure function of the painter's seed, the stream and the place.
float ground_noise(const StrokeScene& scene, std::size_t i, Stream stream, double sigma_m);
// The same with patches that have about sigma_units on the sheet at every distance, and yet lie on the ground as it is seen.
float patch_noise(const StrokeScene& scene, std::size_t i, Stream stream, double sigma_units);
// The same on the sheet, patches of sigma_units.
float sheet_noise(const StrokeScene& scene, glm::vec2 place, Stream stream, double sigma_units);

}  // namespace belvedere
