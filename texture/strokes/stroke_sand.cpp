#include <algorithm>

#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

constexpr float dune_slope_deg = 8.F;  // steeper sand is a dune, with ripples across its slope
constexpr glm::vec3 cool_shade{-0.020F, -0.010F, 0.015F};

}  // namespace

std::vector<Stroke> sand_strokes(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.2F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.class_at(i) != LandCoverClass::sand || scene.parameters.winter)
                 return;  // covered by snow
               // Wind ripples occur in patches; between them sand is bare.
               const float rippled = std::clamp(
                   0.55F + 0.45F * patch_noise(scene, i, Stream::sand_patches, 8.0), 0.1F, 1.F);
               if (seed.uniform() > rippled) return;
               const bool dune = scene.slope_deg(i) > dune_slope_deg;
               const float length = seed.between(3.F, 9.F);
               const float angle = (dune ? quarter_turn : 0.F) + 0.07F * seed.normal();
               const float width = seed.between(0.8F, 1.6F);
               Stroke crest = ground_stroke(scene, i, seed);
               crest.depth_tolerance = tight_depth;
               crest.tone = scene.guidance.tone[i];
               lay_line(crest, scene, position, length, angle, 0.05F, dune, seed);
               take_brush(crest, scene, width,
                          {.taper = 0.5F, .alpha = 0.55F, .bristle = 0.3F, .wetness = 0.02F});
               // Its trough is below it, in cool half shade.
               Stroke trough = crest;
               for (glm::vec2& point : trough.points) point.y += 0.8F * width * scene.scale();
               const float lighter = seed.between(0.4F, 1.0F);
               crest.colour = scene.colour(i, lighter, paint_jitter, seed);
               const float darker = seed.between(0.2F, 0.7F);
               const float clear = 1.F - std::clamp(scene.base.haze[i], 0.F, 1.F);
               trough.colour = scene.colour(i, -darker, paint_jitter, seed) + clear * cool_shade;
               out.push_back(trough);
               out.push_back(crest);
             });
}

}  // namespace belvedere
