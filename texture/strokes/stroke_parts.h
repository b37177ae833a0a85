#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/random.h"
#include "texture/strokes/class_strokes.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Shared by the kinds of stroke: the load of a brush, and the surroundings of a position.
inline constexpr float paint_jitter = 0.018F;  // deviation of a stroke's colour, encoded sRGB
inline constexpr float quarter_turn = 1.57F;   // rad
inline constexpr float tight_depth =
    0.014F;  // rock, snow and scree must not smear across even the smallest ridge

// Load and taper of the brush of one kind of stroke.
struct Brush {
  float taper = 1.F;  // width at the end / at the start
  float alpha = 1.F;
  float bristle = 0.F;
  float wetness = 0.F;
  float load = 1.F;   // 0…1: variation of loads of paint
  float edge = 0.8F;  // how much paint gathers on one side, chosen at random
};
void take_brush(Stroke& stroke, const StrokeScene& scene, float width_units, const Brush& brush);

// A stroke that starts at pixel i, with the common properties.
Stroke ground_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed);
// A stroke of an object that stands on pixel i. All its parts have one load of paint: their hairs
// are seeded by the pixel.
Stroke standing_stroke(const StrokeScene& scene, std::size_t i);
// A straight tapered stroke between two positions, px.
void set_line(Stroke& stroke, glm::vec2 from, glm::vec2 to, float start_width, float end_width);
// Paint seen through the air in front of pixel i: `paint` and the picture's colour mixed by the
// haze.
glm::vec3 through_air(const StrokeScene& scene, std::size_t i, glm::vec3 paint);
// The same for a factor on the picture's colour.
glm::vec3 through_air_factor(const StrokeScene& scene, std::size_t i, glm::vec3 factor);
// Fresh snow at a tone: white in the sun, blue in the shade.
glm::vec3 fresh_snow(float tone);
// Painted after everything else on its own surface, but before nearer objects: for details on top
// of long strokes.
void lay_on_top(Stroke& stroke);

inline bool is_floor(LandCoverClass id) { return has_trait(id, ClassTrait::level); }
inline bool is_ice(LandCoverClass id) { return has_trait(id, ClassTrait::icy); }
inline bool is_grass(LandCoverClass id) { return strokes_of(id).meadow_length > 0.F; }

// Whether a stroke is one of close views (close_share): by chance where near passes into far.
inline bool is_close(const StrokeScene& scene, std::size_t i, StrokeSeed& seed) {
  const float close = close_share(scene.metres_per_unit(i));
  return close >= 1.F || (close > 0.F && seed.uniform() < close);
}
// A stroke that ends with the ground of its own class: near borders are crisp.
inline void end_with_class(Stroke& stroke) { stroke.gate = StrokeGate::same_class; }
// A stroke on one plane of a form: neither its edges nor its light are smeared.
inline void stay_on_plane(Stroke& stroke, const StrokeScene& scene, std::size_t i) {
  stroke.tone_width = 0.08F;
  if (!scene.guidance.rock_facet.empty()) stroke.facet = scene.guidance.rock_facet[i];
}

// Share, 0…1, of eight positions on a circle around that satisfy `test(pixel index)`; positions off
// the canvas count like the centre.
template <class Test>
float share_around(const StrokeScene& scene, glm::vec2 position, float radius_units, Test&& test) {
  // Directions as constants, so that the result does not depend on the machine's sine.
  constexpr float s = 0.7071F;
  constexpr glm::vec2 directions[8] = {{1.F, 0.F},  {s, s},   {0.F, 1.F},  {-s, s},
                                       {-1.F, 0.F}, {-s, -s}, {0.F, -1.F}, {s, -s}};
  const float radius = radius_units * scene.scale();
  int hits = 0;
  for (const glm::vec2 direction : directions) {
    const glm::vec2 there = position + direction * radius;
    hits += test(scene.pixel(scene.on_canvas(there) ? there : position)) ? 1 : 0;
  }
  return static_cast<float>(hits) / 8.F;
}

// Whether water is at an altitude where it is frozen.
inline bool is_frozen(const StrokeScene& scene, std::size_t i) {
  return static_cast<double>(scene.altitude_m(i)) >= scene.parameters.frozen_from_m;
}

// Whether two pixels are on the same slope, with the tolerance that standing objects need.
inline bool on_same_slope(const StrokeScene& scene, std::size_t here, std::size_t there) {
  return std::abs(scene.guidance.depth_m[there] / scene.guidance.depth_m[here] - 1.F) <= 0.03F;
}
// Density of detail around a position of the sheet, 0 calm … 1 busy: calm areas alternate with
// detailed ones on all kinds of ground.
float hand_busy_at(const StrokeScene& scene, glm::vec2 position);

// Whether there is grass at pixel i: on meadows of every kind, and in the glades of forests.
bool is_grassy(const StrokeScene& scene, std::size_t i);

// Noise of deviation 1 on the ground, patches of sigma_m; a pure function of the painter's seed,
// the stream and the position.
float ground_noise(const StrokeScene& scene, std::size_t i, Stream stream, double sigma_m);
// The same with patches of about sigma_units on the sheet at every distance, yet fixed to the
// visible ground.
float patch_noise(const StrokeScene& scene, std::size_t i, Stream stream, double sigma_units);
// The same on the sheet, patches of sigma_units.
float sheet_noise(const StrokeScene& scene, glm::vec2 position, Stream stream, double sigma_units);

}  // namespace belvedere
