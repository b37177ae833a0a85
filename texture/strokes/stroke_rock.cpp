#include <algorithm>
#include <cmath>

#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float tone_of_m = 0.17F;        // change of tone in scene.colour for m = 1
constexpr float wall_m_per_unit = 22.0F;  // ground in a unit at which strokes have the sizes below
constexpr float broken_hue =
    0.020F;  // deviation, encoded sRGB: strokes warmer and cooler than their plane

// One pass of the brush over a wall. Lengths in units.
struct RockPass {
  float spacing;
  float shortest, longest;
  float narrowest, widest;
  float alpha;
  float tone;        // deviation of the stroke's tone from its plane's
  float across;      // share of strokes across their plane …
  float across_rad;  // … by this angle
  float min;         // share of strokes painted in calm areas, relative to busy ones
};

// Density of detail, 0 calm … 1 busy.
float busy_at(const StrokeScene& scene, glm::vec2 position) {
  return std::clamp(0.6F + 0.35F * sheet_noise(scene, position, Stream::rock_calm, 13.0), 0.F, 1.F);
}

// Size of strokes by the planes they lie on: broad on near walls, small on far ones.
float facet_size_at(const StrokeScene& scene, std::size_t i) {
  return std::clamp(wall_m_per_unit / std::max(scene.metres_per_unit(i), 0.01F), 0.55F, 1.25F);
}

// A stroke belongs to its plane: it has the plane's direction and tone, and ends where it ends.
std::vector<Stroke> paint_planes(const StrokeScene& scene, Stream stream, const RockPass& pass,
                                 float order) {
  return sow(
      scene, pass.spacing, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        if (scene.class_at(i) != rock) return;
        const float busy = busy_at(scene, position);
        if (seed.uniform() > pass.min + (1.F - pass.min) * busy) return;
        const float tone = scene.guidance.tone[i];
        const float shade = std::clamp((0.55F - tone) / 0.30F, 0.F, 1.F);
        Stroke stroke = ground_stroke(scene, i, seed);
        stroke.depth_tolerance = tight_depth;
        stroke.tone = tone;
        stroke.tone_width = 0.06F;
        if (!scene.guidance.rock_facet.empty()) stroke.facet = scene.guidance.rock_facet[i];
        const float later = seed.uniform();
        stroke.order += order + 60.F * later;
        const float size = facet_size_at(scene, i);
        const float drawn = seed.uniform();
        const float stray = 0.14F * seed.normal();
        const float side = seed.uniform() < 0.5F ? -1.F : 1.F;
        const float angle = stray + (drawn < pass.across ? side * pass.across_rad : 0.F);
        const float length = seed.between(pass.shortest, pass.longest) * size;
        lay_line(stroke, scene, position, length, angle, 0.05F, true, seed);
        const float width = seed.between(pass.narrowest, pass.widest) * size;
        const float taper = seed.between(0.55F, 1.0F);
        take_brush(stroke, scene, width,
                   {.taper = taper, .alpha = pass.alpha, .bristle = 0.10F, .wetness = 0.02F});
        const float calmer =
            (1.F - 0.4F * shade) * (0.55F + 0.45F * busy) * (1.F - 0.5F * scene.base.haze[i]);
        const float m = std::clamp(pass.tone / tone_of_m * calmer * seed.normal(), -1.5F, 1.5F);
        stroke.colour = scene.colour(i, m, 0.F, seed);
        const float warm = broken_hue * (1.F - 0.4F * shade) * seed.normal();
        stroke.colour += glm::vec3(warm, 0.15F * warm, -warm);
        out.push_back(stroke);
      });
}

}  // namespace

std::vector<Stroke> rock_facets(const StrokeScene& scene, Stream stream) {
  constexpr RockPass pass{.spacing = 3.0F,
                          .shortest = 6.4F,
                          .longest = 12.8F,
                          .narrowest = 2.6F,
                          .widest = 4.5F,
                          .alpha = 0.85F,
                          .tone = 0.05F,
                          .across = 0.F,
                          .across_rad = 0.F,
                          .min = 0.55F};
  return paint_planes(scene, stream, pass, 460.F);
}

std::vector<Stroke> rock_dabs(const StrokeScene& scene, Stream stream) {
  constexpr RockPass pass{.spacing = 2.0F,
                          .shortest = 3.2F,
                          .longest = 6.7F,
                          .narrowest = 1.3F,
                          .widest = 2.4F,
                          .alpha = 0.75F,
                          .tone = 0.085F,
                          .across = 0.30F,
                          .across_rad = 1.35F,
                          .min = 0.55F};
  return paint_planes(scene, stream, pass, 300.F);
}

std::vector<Stroke> rock_chips(const StrokeScene& scene, Stream stream) {
  constexpr RockPass pass{.spacing = 1.3F,
                          .shortest = 1.7F,
                          .longest = 4.0F,
                          .narrowest = 0.6F,
                          .widest = 1.3F,
                          .alpha = 0.80F,
                          .tone = 0.12F,
                          .across = 0.45F,
                          .across_rad = quarter_turn - 0.12F,
                          .min = 0.20F};
  return paint_planes(scene, stream, pass, 100.F);
}

}  // namespace belvedere
