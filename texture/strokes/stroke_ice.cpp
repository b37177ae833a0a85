#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "texture/strokes/ice_flow.h"
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
  const IceFlow flow = find_ice_flow(scene);
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
    lay_flow(stroke, flow, place, length * scene.scale(), aside);
    take_brush(stroke, scene, id == glacier ? seed.between(4.F, 8.5F) : seed.between(3.6F, 8.F),
               {.taper = 0.5F, .alpha = 0.55F, .bristle = 0.22F, .wetness = 0.012F, .load = 0.4F});
    stroke.colour = scene.colour(i, (id == glacier ? 0.7F : 0.85F) * mixed_tone(0.16F, 0.16F, seed), paint_jitter * 0.4F, seed);
    out.push_back(stroke);
  });
}

// A rib of rock: a shaded body down the fall line, broken at its edges, and the lit faces of its blocks towards the sun.
std::vector<Stroke> snow_ribs(const StrokeScene& scene, Stream stream) {
  const IceFlow flow = find_ice_flow(scene);
  return sow(scene, 22.F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != snow) return;
    const float bare = std::clamp((scene.slope_deg(i) - 30.F) / 12.F, 0.F, 1.F) * std::clamp(scene.relief_m(i) / 20.F - 0.15F, 0.F, 1.F);
    // Ribs gather; single ones would be flies on the snow.
    const float gathered = std::clamp(1.2F * sheet_noise(scene, place, Stream::rib_places, 40.0) - 0.1F, 0.F, 1.F);
    if (bare * gathered < 0.25F || seed.uniform() > 1.5F * bare * gathered) return;
    const float scale = scene.scale();
    const int steps = 9 + static_cast<int>(seed.uniform() * 9.F);
    const std::vector<glm::vec2> crest = trace_ice(scene, flow, place, 3.F * scale, steps);
    if (crest.size() < 9) return;
    const float sunwards = scene.parameters.sun_side < 0.0 ? -1.F : 1.F;
    const float widest = seed.between(4.F, 7.5F);
    float drift = 0.F;  // the crest wavers
    for (std::size_t k = 0; k + 2 < crest.size(); ++k) {
      const std::size_t here = scene.pixel(crest[k]);
      const glm::vec2 down = flow.at(crest[k]);
      const glm::vec2 to_sun = glm::vec2(down.y > 0.F ? sunwards : -sunwards, 0.F);
      const float share = (static_cast<float>(k) + 0.5F) / static_cast<float>(crest.size() - 2);
      const float size = widest * (0.3F + 2.8F * share * (1.F - share)) * seed.between(0.45F, 1.3F);
      drift = std::clamp(drift + 0.9F * seed.normal(), -most_drift_units, most_drift_units);
      const glm::vec2 at = crest[k] + to_sun * (drift * scale);
      const float tone = std::clamp(scene.guidance.tone[here], 0.F, 1.F);
      for (const bool is_lit : {false, true}) {
        if (seed.uniform() < 0.22F) continue;  // snow lies across it
        Stroke stroke = ground_stroke(scene, here, seed);
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
        stroke.colour = through_air(scene, here, paint + value);
        out.push_back(stroke);
      }
    }
  });
}

}  // namespace belvedere
