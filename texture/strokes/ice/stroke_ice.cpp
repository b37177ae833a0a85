#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "texture/strokes/ice/ice_ways.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float steep_deg = 24.F;

// Near snow is painted plane by plane: short flat strokes, down where it is steep, else across.
void lay_close_snow(Stroke& stroke, const StrokeScene& scene, glm::vec2 position, std::size_t i,
                    StrokeSeed& seed) {
  end_with_class(stroke);
  stay_on_plane(stroke, scene, i);
  const bool steep = scene.guidance.slope_deg[i] > steep_deg;
  const float angle = (steep ? 0.F : 1.4F) + (steep ? 0.14F : 0.35F) * seed.normal();
  lay_line(stroke, scene, position, seed.between(5.F, 13.F), angle, 0.06F, true, seed);
  take_brush(stroke, scene, seed.between(2.2F, 4.6F),
             {.taper = 0.7F, .alpha = 0.5F, .bristle = 0.1F, .wetness = 0.012F, .load = 0.4F});
  stroke.colour = scene.colour(i, 0.5F * mixed_tone(0.16F, 0.16F, seed), paint_jitter * 0.4F, seed);
}

}  // namespace

std::vector<Stroke> snow_strokes(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 5.6F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const LandCoverClass id = scene.class_at(i);
        if (!is_ice(id)) return;
        Stroke stroke = ground_stroke(scene, i, seed);
        stroke.depth_tolerance = tight_depth;
        stroke.tone = scene.guidance.tone[i];
        stroke.order += seed.uniform() * 150.F;
        const float u = seed.uniform();
        if (is_close(scene, i, seed)) {
          lay_close_snow(stroke, scene, position, i, seed);
          out.push_back(stroke);
          return;
        }
        // Broad and calm: firn is smooth, and a glacier has long strokes along its flow.
        const float length = id == glacier ? seed.between(30.F, 64.F) : 15.F + 34.F * u * u;
        const float aside = (id == glacier ? 0.05F : 0.14F) * seed.normal();
        lay_flow(stroke, scene, position, length * scene.scale(), aside);
        take_brush(
            stroke, scene, id == glacier ? seed.between(4.F, 8.5F) : seed.between(3.6F, 8.F),
            {.taper = 0.5F, .alpha = 0.55F, .bristle = 0.22F, .wetness = 0.012F, .load = 0.4F});
        stroke.colour =
            scene.colour(i, (id == glacier ? 0.7F : 0.85F) * mixed_tone(0.16F, 0.16F, seed),
                         paint_jitter * 0.4F, seed);
        out.push_back(stroke);
      });
}

}  // namespace belvedere
