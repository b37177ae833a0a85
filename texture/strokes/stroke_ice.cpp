#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "texture/strokes/ice_ways.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Rock that stands out of snow, encoded sRGB: its lit and its shaded side in full light.
constexpr glm::vec3 lit_rock{0.80F, 0.72F, 0.64F};
constexpr glm::vec3 shaded_rock{0.42F, 0.40F, 0.50F};

constexpr float most_drift_units = 15.F;  // of a rib's crest from the fall line; one in thousands comes so far

}  // namespace

std::vector<Stroke> snow_strokes(const StrokeScene& scene, Stream stream) {
  return sow(scene, 5.6F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if (!is_ice(id)) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    stroke.tone = scene.guidance.tone[i];
    stroke.order += seed.uniform() * 150.F;
    const float u = seed.uniform();
    // Broad and quiet: firn lies smooth, and a glacier is drawn in one go along its flow.
    const float length = id == glacier ? seed.between(30.F, 64.F) : 15.F + 34.F * u * u;
    const float aside = (id == glacier ? 0.05F : 0.14F) * seed.normal();
    lay_flow(stroke, scene, place, length * scene.scale(), aside);
    take_brush(stroke, scene, id == glacier ? seed.between(4.F, 8.5F) : seed.between(3.6F, 8.F),
               {.taper = 0.5F, .alpha = 0.55F, .bristle = 0.22F, .wetness = 0.012F, .load = 0.4F});
    stroke.colour = scene.colour(i, (id == glacier ? 0.7F : 0.85F) * mixed_tone(0.16F, 0.16F, seed), paint_jitter * 0.4F, seed);
    out.push_back(stroke);
  });
}

// A rib of rock: a shaded body down the fall line, broken at its edges, and the lit faces of its blocks towards the sun.
std::vector<Stroke> snow_ribs(const StrokeScene& scene, Stream stream) {
  const float scale = scene.scale();
  const float sunwards = scene.parameters.sun_side < 0.0 ? -1.F : 1.F;
  std::vector<Stroke> out;
  along_ways(scene, stream, [&](const IceWay& crest) {
    const float widest = way_seed(scene, crest, 0).between(4.F, 7.5F);
    float drift = 0.F;  // the crest wavers
    const std::size_t blocks = crest.places.size() - 2;
    for (std::size_t k = 0; k < blocks; ++k) {
      StrokeSeed seed = way_seed(scene, crest, 1 + k);
      drift = std::clamp(drift + 0.9F * seed.normal(), -most_drift_units, most_drift_units);
      const auto here = way_pixel(scene, crest, k);
      if (!here) continue;
      const glm::vec2 place = way_place(scene, crest, k);
      const glm::vec2 down = ice_direction(scene, place);
      const glm::vec2 to_sun = glm::vec2(down.y > 0.F ? sunwards : -sunwards, 0.F);
      const float share = (static_cast<float>(k) + 0.5F) / static_cast<float>(blocks);
      const float size = widest * (0.3F + 2.8F * share * (1.F - share)) * seed.between(0.45F, 1.3F);
      const glm::vec2 at = place + to_sun * (drift * scale);
      const float tone = std::clamp(scene.guidance.tone[*here], 0.F, 1.F);
      for (const bool is_lit : {false, true}) {
        if (seed.uniform() < 0.22F) continue;  // snow lies across it
        Stroke stroke = ground_stroke(scene, *here, seed);
        stroke.depth_tolerance = tight_depth;
        stroke.gate = StrokeGate::same_class;
        lay_on_top(stroke);
        const glm::vec2 aside = to_sun * (is_lit ? 0.42F : -0.22F) * size * scale;
        const float length = (is_lit ? seed.between(2.5F, 5.F) : seed.between(5.F, 9.F)) * scale;
        const glm::vec2 heading = glm::normalize(down + to_sun * (is_lit ? 0.25F : -0.35F));
        set_line(stroke, at + aside - heading * (0.4F * length), at + aside + heading * (0.6F * length), 0.F, 0.F);
        take_brush(stroke, scene, is_lit ? 0.55F * size : size,
                   {.taper = 0.45F, .alpha = is_lit ? 0.75F : 0.85F, .bristle = 0.3F, .wetness = 0.03F});
        const float value = 0.03F * seed.normal();
        const glm::vec3 paint = is_lit ? lit_rock * (0.60F + 0.42F * tone) : shaded_rock * (0.80F + 0.35F * tone);
        stroke.colour = through_air(scene, *here, paint + value);
        out.push_back(stroke);
      }
    }
  });
  return out;
}

}  // namespace belvedere
