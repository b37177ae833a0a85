#include <algorithm>
#include <cmath>

#include "texture/strokes/class_strokes.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

bool is_open_grass(LandCoverClass id) { return is_grass(id) && !is_floor(id); }

// Difference in lightness of the sky at some units around a position: large at the edges of clouds.
float cloud_edge(const StrokeScene& scene, glm::vec2 position, std::size_t i) {
  float max = 0.F;
  for (const float reach : {-22.F, -9.F, 9.F, 22.F}) {
    const glm::vec2 there = position + glm::vec2(reach * scene.scale(), 0.F);
    if (!scene.on_canvas(there)) continue;
    const std::size_t k = scene.pixel(there);
    if (scene.guidance.is_sky(k))
      max = std::max(max, std::abs(scene.base.colour[k].x - scene.base.colour[i].x));
  }
  return max;
}

}  // namespace

std::vector<Stroke> sky_strokes(const StrokeScene& scene, Stream stream) {
  return sow(scene, 5.F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (!scene.guidance.is_sky(i)) return;
               Stroke stroke = ground_stroke(scene, i, seed);
               stroke.gate = StrokeGate::sky;
               // The sky has level strokes, within 3°; at the edge of a cloud a long stroke would
               // smear, so there the brush dabs.
               const float edge = cloud_edge(scene, position, i);
               const float dab = std::clamp((edge - 0.02F) / 0.05F, 0.F, 1.F);
               const float angle = std::clamp(0.018F * seed.normal(), -0.03F, 0.03F);
               const float length = seed.between(26.F, 66.F) * (1.F - 0.80F * dab);
               lay_line(stroke, scene, position, length, angle, 0.006F, false, seed);
               take_brush(stroke, scene, seed.between(5.F, 11.F) * (1.F - 0.35F * dab),
                          {.taper = 0.8F,
                           .alpha = 0.28F,
                           .bristle = 0.14F,
                           .wetness = 0.004F,
                           .load = 0.35F,
                           .edge = 0.2F});
               stroke.colour = scene.colour(i, 0.2F * seed.normal(), 0.004F, seed);
               stroke.order = seed.uniform();
               out.push_back(stroke);
             });
}

std::vector<Stroke> wash_strokes(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 4.4F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const LandCoverClass id = scene.class_at(i);
        const ClassStrokes& brush = strokes_of(id);
        if (brush.wash_length <= 0.F) return;
        Stroke stroke = ground_stroke(scene, i, seed);
        const bool wooded = id == forest && !is_grassy(scene, i);
        stroke.depth_tolerance = has_trait(id, ClassTrait::tight) ? tight_depth : 0.03F;
        if (!wooded) stroke.tone = scene.guidance.tone[i];
        const float turn =
            is_grass(id) && !is_floor(id) && seed.uniform() < 0.35F ? quarter_turn : 0.F;
        // Under trees in all directions: strokes visible between crowns must not look
        // combed.
        const float angle = turn + seed.normal() * (wooded ? 0.9F : brush.wash_wander_rad);
        const bool ice = is_ice(id);
        // Near loose stone and snow are dabbed: dense lines down the slope would be fur.
        const bool near = (id == scree || ice || is_open_grass(id)) && is_close(scene, i, seed);
        if (near) end_with_class(stroke);
        const bool snowy = near && (ice || scene.parameters.winter);
        if (snowy || (near && id == scree)) stay_on_plane(stroke, scene, i);
        const float length = near ? std::min(brush.wash_length, 5.5F) : brush.wash_length;
        const float wander = near ? (snowy         ? 0.1F
                                     : id == scree ? 1.1F
                                                   : 0.5F) *
                                        seed.normal()
                                  : 0.F;
        lay_line(stroke, scene, position, length * seed.between(0.7F, 1.3F), angle + wander, 0.2F,
                 !is_floor(id), seed);
        take_brush(stroke, scene, brush.wash_width * seed.between(0.7F, 1.3F),
                   {.taper = 0.6F,
                    .alpha = 0.80F,
                    .bristle = ice ? 0.25F : 0.35F,
                    .wetness = ice ? 0.015F : 0.03F,
                    .load = ice ? 0.4F : 1.F});
        stroke.colour = scene.colour(i,
                                     wooded ? -0.55F + 0.35F * seed.normal()
                                            : (snowy ? 0.5F : 1.F) * mixed_tone(0.22F, 0.15F, seed),
                                     paint_jitter, seed);
        stroke.order += seed.uniform() * 300.F;
        out.push_back(stroke);
      });
}

std::vector<Stroke> meadow_strokes(const StrokeScene& scene, Stream stream) {
  return sow(scene, 4.2F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               const LandCoverClass id = scene.class_at(i);
               if (!is_grass(id)) return;
               Stroke stroke = ground_stroke(scene, i, seed);
               const float length = strokes_of(id).meadow_length * seed.between(0.6F, 1.4F);
               if (is_floor(id)) {
                 lay_line(stroke, scene, position, length, seed.normal() * 0.12F, 0.1F, false,
                          seed);
               } else {
                 const float turn = seed.uniform() < 0.5F ? 0.F : quarter_turn;
                 // Near slopes are drawn along their contours, as their terracettes run.
                 const bool near = is_close(scene, i, seed);
                 if (near && scene.parameters.winter) return;  // under snow, which is washed
                 if (near) end_with_class(stroke);
                 lay_line(stroke, scene, position, near ? 0.6F * length : length,
                          (near ? quarter_turn : turn) + 0.25F * seed.normal(), 0.2F, true, seed);
               }
               take_brush(stroke, scene, (is_floor(id) ? 2.2F : 2.6F) * seed.between(0.7F, 1.3F),
                          {.taper = 0.5F, .alpha = 0.6F, .bristle = 0.4F, .wetness = 0.03F});
               // Whole patches are darker or lighter, so that a slope is varied and has no uniform
               // grain.
               const float patch =
                   is_floor(id) ? 0.F : 0.24F * patch_noise(scene, i, Stream::meadow_patches, 7.0);
               const float busy = hand_busy_at(scene, position);
               const float mixed = mixed_tone(0.02F + 0.34F * busy, 0.02F + 0.32F * busy, seed);
               stroke.colour =
                   scene.colour(i, mixed + (0.20F + 1.0F * busy) * std::clamp(patch, -0.5F, 0.5F),
                                paint_jitter * (0.4F + 1.6F * busy), seed);
               out.push_back(stroke);
             });
}

std::vector<Stroke> grass_flecks(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.4F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               const LandCoverClass id = scene.class_at(i);
               if (!is_grass(id) || is_floor(id)) return;
               // Tussocks, alder and juniper gather in patches and hollows, with flecks of light
               // between.
               const float patch = patch_noise(scene, i, Stream::fleck_patches, 6.0) -
                                   0.10F * std::clamp(scene.relief_m(i), -10.F, 10.F);
               const bool dark = seed.uniform() < 0.6F;
               if (seed.uniform() > 0.05F + 1.1F * hand_busy_at(scene, position)) return;
               if (seed.uniform() > (dark ? 0.60F * std::clamp(patch - 0.1F, 0.F, 1.3F)
                                          : 0.30F * std::clamp(0.6F - patch, 0.F, 1.F)))
                 return;
               Stroke stroke = ground_stroke(scene, i, seed);
               stroke.depth_tolerance = tight_depth;
               lay_on_top(stroke);
               const float length = dark ? seed.between(1.6F, 4.2F) : seed.between(1.2F, 2.8F);
               lay_line(stroke, scene, position, length, quarter_turn + 0.35F * seed.normal(), 0.2F,
                        true, seed);
               take_brush(stroke, scene, dark ? seed.between(1.2F, 2.2F) : seed.between(0.7F, 1.3F),
                          {.taper = 0.5F, .alpha = dark ? 0.62F : 0.7F});
               const float clear = 1.F - std::clamp(scene.base.haze[i], 0.F, 1.F);
               if (dark) {
                 stroke.colour = scene.colour(i, -seed.between(0.7F, 1.4F), paint_jitter, seed);
                 // Alpine roses and bilberries: patches of rust red at altitude, among the greens.
                 const bool rust =
                     id == alpine_grass && patch_noise(scene, i, Stream::copses, 9.0) > 0.9F;
                 const glm::vec3 leaves =
                     rust ? glm::vec3(1.16F, 0.80F, 0.74F) : glm::vec3(0.80F, 0.92F, 0.82F);
                 if (!scene.parameters.winter)
                   stroke.colour *= through_air_factor(scene, i, leaves);
               } else {
                 const float light = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
                 stroke.colour = scene.colour(i, seed.between(0.7F, 1.4F), paint_jitter, seed) +
                                 clear * light * glm::vec3(0.05F, 0.02F, -0.02F);
               }
               out.push_back(stroke);
             });
}

std::vector<Stroke> scree_strokes(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 3.2F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        if (scene.class_at(i) != scree) return;
        Stroke stroke = ground_stroke(scene, i, seed);
        stroke.depth_tolerance = tight_depth;
        stroke.tone = scene.guidance.tone[i];
        const float u = seed.uniform();
        if (is_close(scene, i, seed)) {
          if (scene.parameters.winter) return;  // under snow, which is washed
          // Dabs as wide as long, some of them across.
          end_with_class(stroke);
          stay_on_plane(stroke, scene, i);
          stroke.tone_width = 0.11F;
          const float turn = seed.uniform() < 0.4F ? quarter_turn : 0.F;
          const float length = seed.between(1.6F, 4.2F);
          lay_line(stroke, scene, position, length, turn + 0.35F * seed.normal(), 0.1F, true, seed);
          take_brush(stroke, scene, seed.between(1.3F, 2.8F), {.taper = 0.7F, .alpha = 0.55F});
        } else {
          lay_line(stroke, scene, position, 1.5F + 4.F * u * u, 0.15F * seed.normal(), 0.1F, true,
                   seed);
          take_brush(stroke, scene, seed.between(1.1F, 2.2F), {.taper = 0.7F, .alpha = 0.6F});
        }
        stroke.colour = scene.colour(i, mixed_tone(0.26F, 0.33F, seed), paint_jitter * 1.4F, seed);
        out.push_back(stroke);
      });
}

std::vector<Stroke> broken_colour(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 4.F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const LandCoverClass id = scene.class_at(i);
        const DabHue dabs = strokes_of(id).dabs;
        if (dabs == DabHue::none ||
            seed.uniform() > (is_ice(id) ? 0.40F : 0.10F + 0.85F * hand_busy_at(scene, position)))
          return;
        // Near snow has forms instead.
        if (is_ice(id) && is_close(scene, i, seed) && seed.uniform() > 0.2F) return;
        Stroke stroke = ground_stroke(scene, i, seed);
        stroke.depth_tolerance = tight_depth;
        // On walls just in front of what lies there, so that trees in front of them stay whole.
        stroke.order -= id == rock ? 7.F : 0.5F * tight_depth * stroke.depth_m;
        const float tone = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
        // In all directions; otherwise a slope would look combed.
        const float angle = 1.1F * seed.normal();
        const float u = seed.uniform();
        lay_line(stroke, scene, position, 1.2F + 3.4F * u * u, angle, 0.3F, true, seed);
        take_brush(stroke, scene, seed.between(0.7F, 1.7F),
                   {.taper = 0.5F, .alpha = is_ice(id) ? 0.32F : 0.55F});
        const float n = seed.normal();
        stroke.colour = scene.colour(
            i, n < 0.F ? -seed.between(0.3F, 1.1F) : seed.between(0.3F, 1.1F), paint_jitter, seed);
        // Warm next to cool: ochre and rose in the light of rock and grass, violet in the shade,
        // rose and blue on snow.
        const float clear = 1.F - std::clamp(scene.base.haze[i], 0.F, 1.F);
        const float warm = seed.normal() + 1.2F * (tone - 0.5F);
        const glm::vec3 turn = dabs == DabHue::ice      ? glm::vec3(0.014F, 0.001F, -0.010F)
                               : dabs == DabHue::leaves ? glm::vec3(0.045F, 0.018F, -0.020F)
                                                        : glm::vec3(0.050F, 0.004F, -0.035F);
        stroke.colour += turn * (warm * clear);
        out.push_back(stroke);
      });
}

std::vector<Stroke> water_strokes(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.2F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.class_at(i) != water) return;
               Stroke stroke = ground_stroke(scene, i, seed);
               stroke.gate = StrokeGate::water;
               // Water has long level strokes; ice is dabbed, so that its drifts and cracks keep
               // their shapes.
               const bool frozen = is_frozen(scene, i);
               const float angle = seed.normal() * (frozen ? 0.10F : 0.015F);
               lay_line(stroke, scene, position, (frozen ? 0.32F : 1.F) * seed.between(10.F, 26.F),
                        angle, 0.02F, false, seed);
               take_brush(stroke, scene, (frozen ? 0.6F : 1.F) * seed.between(1.4F, 3.2F),
                          {.taper = 0.5F, .alpha = 0.5F, .bristle = 0.4F, .wetness = 0.02F});
               stroke.colour =
                   scene.colour(i, mixed_tone(0.15F, 0.22F, seed), paint_jitter * 0.6F, seed);
               out.push_back(stroke);
             });
}

std::vector<Stroke> accent_strokes(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 2.6F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const float edge = scene.base.accent[i];
        const LandCoverClass id = scene.class_at(i);
        if (std::abs(edge) < 0.25F || seed.uniform() > std::abs(edge)) return;
        if (!has_trait(id, ClassTrait::accents)) return;
        Stroke stroke = ground_stroke(scene, i, seed);
        stroke.depth_tolerance = 0.01F;
        // Over everything on its own ground, and under what stands in front of it.
        stroke.order -= 10.F + seed.uniform();
        const float angle = (edge > 0.F ? 0.3F : 0.2F) * seed.normal();
        lay_line(stroke, scene, position, seed.between(4.F, 11.F), angle, 0.1F, true, seed);
        take_brush(
            stroke, scene, seed.between(1.1F, 2.2F),
            {.taper = 0.3F, .alpha = 0.55F * std::min(1.F, std::abs(edge)), .bristle = 0.2F});
        stroke.colour = scene.colour(i, edge > 0.F ? 1.1F : -1.1F, paint_jitter * 0.6F, seed);
        out.push_back(stroke);
      });
}

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
