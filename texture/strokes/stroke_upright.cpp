#include <algorithm>
#include <cmath>

#include "texture/strokes/parcels.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"
#include "texture/strokes/stroke_trees.h"

namespace belvedere {
namespace {

constexpr glm::vec3 bare_twigs{0.78F, 0.70F, 0.70F};  // a factor on the shade of snow

using enum LandCoverClass;

// 1 on the borders of some fields, where hedges grow.
float hedge_at(const StrokeScene& scene, std::size_t i) {
  const glm::dvec3 p = glm::dvec3(scene.guidance.position_m[i]) + scene.guidance.origin_m;
  const Parcel parcel =
      parcel_at(scene.parameters.seed, p.x, p.y, scene.metres_per_unit(i), scene.guidance.grain[i]);
  return parcel.border_m < 0.09F * parcel.width_m && parcel.hedged ? 1.F : 0.F;
}

// A thicket in winter: a mauve haze of twigs on the snow, close together, and few of them upright
// before it. Lone dots would look like pepper.
void draw_thicket(const StrokeScene& scene, glm::vec2 position, std::size_t i, StrokeSeed& seed,
                  std::vector<Stroke>& out) {
  constexpr float thicket_from = 0.75F;  // of noise of deviation 1
  const float dense = (sheet_noise(scene, position, Stream::copses, 11.0) - thicket_from) / 0.9F;
  if (dense <= 0.F) return;
  const float scale = scene.scale();
  const float strength = std::min(1.F, dense);
  const glm::vec3 twigs =
      scene.colour(i, -0.7F, 0.5F * paint_jitter, seed) * through_air_factor(scene, i, bare_twigs);
  Stroke haze = standing_stroke(scene, i);
  haze.order = haze.depth_m;
  const float length = seed.between(5.F, 9.F);
  set_line(haze, position - glm::vec2(0.5F * length * scale, 0.F),
           position + glm::vec2(0.5F * length * scale, -0.6F * scale), 4.2F * scale, 3.F * scale);
  haze.alpha = 0.10F + 0.22F * strength;
  haze.colour = twigs;
  out.push_back(haze);
  const int count = static_cast<int>(4.F * strength * seed.uniform() + 0.3F);
  for (int k = 0; k < count; ++k) {
    const float right = seed.between(-2.4F, 2.4F);
    const float down = seed.between(-1.2F, 1.2F);
    const float height = seed.between(1.2F, 2.2F);
    const glm::vec2 foot = position + glm::vec2(right, down) * scale;
    if (!scene.on_canvas(foot) || !on_same_slope(scene, i, scene.pixel(foot))) continue;
    Stroke twig = standing_stroke(scene, i);
    twig.order = twig.depth_m - 0.5F;
    twig.gate = StrokeGate::upright;
    set_line(twig, foot, foot - glm::vec2(0.F, height * scale), 1.3F * scale, 0.5F * scale);
    twig.alpha = 0.35F + 0.2F * strength;
    twig.colour = twigs;
    out.push_back(twig);
  }
}

}  // namespace

// Grass in glades, over the other paint: short strokes down the slope and across it.
std::vector<Stroke> glade_grass(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.6F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.class_at(i) != forest || !is_grassy(scene, i)) return;
               Stroke stroke = ground_stroke(scene, i, seed);
               stroke.order += 2.F;  // before the trees around
               // Mown and grazed grass lies across its slope; crossing strokes look like straw on a
               // large sheet.
               constexpr float across_share = 0.85F;
               const float turn = seed.uniform() < across_share ? quarter_turn : 0.F;
               const float length = seed.between(2.5F, 6.F);
               lay_line(stroke, scene, position, length, turn + 0.18F * seed.normal(), 0.25F, true,
                        seed);
               take_brush(stroke, scene, seed.between(1.6F, 2.8F),
                          {.taper = 0.5F, .alpha = 0.5F, .bristle = 0.4F, .wetness = 0.03F});
               stroke.colour = scene.colour(i, mixed_tone(0.28F, 0.12F, seed), paint_jitter, seed);
               out.push_back(stroke);
             });
}

std::vector<Stroke> scattered_trees(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 4.2F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const LandCoverClass id = scene.class_at(i);
        if (!has_trait(id, ClassTrait::lone_trees)) return;
        const auto is = [&](LandCoverClass asked) {
          return [&scene, asked](std::size_t k) { return scene.class_at(k) == asked; };
        };
        // Stretches along brooks and fields that are planted, and areas with copses; the land
        // between is bare.
        const float stretch = patch_noise(scene, i, Stream::tree_stretches, 12.0);
        const float copse = patch_noise(scene, i, Stream::copses, 5.0);
        const float before_forest = share_around(scene, position, 7.F, is(forest));
        float share = 0.F;
        int max = 3;
        if (id == alpine_grass) {
          const float outpost = 0.14F * share_around(scene, position, 15.F, is(forest));
          share = (0.30F * before_forest + outpost) * std::clamp(0.4F + 0.8F * copse, 0.F, 1.5F);
        } else {
          share = 0.22F * before_forest * std::clamp(0.2F + copse, 0.F, 1.F);
          if (copse > 1.9F) {
            share += 0.40F;
            max = 6;
          } else if (stretch > 0.8F) {
            share += 0.004F;  // a lone tree
          }
        }
        if (id == valley_floor) {
          const bool bank = share_around(scene, position, 3.2F, is(water)) > 0.F;
          if (bank) share += 0.75F * std::clamp(0.2F + 0.9F * stretch, 0.03F, 1.F);
          share += 0.42F * hedge_at(scene, i) * std::clamp(0.9F * stretch - 0.2F, 0.F, 1.F);
          share += 0.06F * share_around(scene, position, 6.F, is(settlement));
        }
        if (seed.uniform() > share) return;
        const float scale = scene.scale();
        const float crowd = seed.uniform();
        const int count = 1 + static_cast<int>(crowd * crowd * static_cast<float>(max));
        const bool spruces = id == alpine_grass || seed.uniform() < 0.2F + 0.5F * before_forest;
        const float size = seed.between(0.7F, 1.1F);
        glm::vec2 foot = position;
        for (int k = 0; k < count; ++k) {
          if (k > 0) {
            // Clustered: crowns touch, each slightly nearer or farther than the last.
            const float aside = seed.between(0.9F, 2.0F);
            const float way = seed.uniform() < 0.6F ? 1.F : -1.F;
            const float down = 0.8F * seed.normal();
            foot += glm::vec2(aside * way, down) * scale;
          }
          if (!scene.on_canvas(foot)) break;
          const std::size_t here = scene.pixel(foot);
          if (!is_grass(scene.class_at(here)) || !on_same_slope(scene, i, here)) break;
          const float width = 2.7F * scale * size * seed.between(0.6F, 1.35F);
          const TreeTone tone{0.2F * seed.normal() - 0.25F, 0.6F, 1.F};
          std::vector<Stroke> tree;
          if (spruces)
            plant_spruce(scene, {foot, width, 2.2F * width}, here, tone, seed, tree);
          else
            plant_leafy(scene, {foot, 1.2F * width, 1.35F * width}, here, tone, seed, tree);
          // They stand on grass, whose colours they would take: leaves are darker and greener.
          const glm::vec3 leaves =
              scene.parameters.winter
                  ? through_air_factor(scene, here, glm::vec3(0.60F, 0.66F, 0.74F))
                  : through_air_factor(scene, here, glm::vec3(0.70F, 0.84F, 0.74F));
          for (Stroke& stroke : tree) {
            if (stroke.gate == StrokeGate::upright) stroke.colour *= leaves;
            out.push_back(stroke);
          }
        }
      });
}

std::vector<Stroke> low_bushes(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 4.2F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const LandCoverClass id = scene.class_at(i);
        if ((id != alpine_grass && id != shrub) || seed.uniform() > scene.base.tree_density[i])
          return;
        if (scene.parameters.winter) {
          draw_thicket(scene, position, i, seed, out);
          return;
        }
        const float scale = scene.scale();
        const float width = 2.6F * scale * seed.between(0.6F, 1.4F);
        Stroke stroke = standing_stroke(scene, i);
        stroke.order = stroke.depth_m - 0.5F;
        stroke.gate = StrokeGate::upright;
        set_line(stroke, position - glm::vec2(0.4F * width, 0.F),
                 position + glm::vec2(0.5F * width, -0.4F * scale), width, width * 0.7F);
        stroke.alpha = 0.7F;
        stroke.colour = scene.colour(i, -seed.between(1.2F, 1.4F), paint_jitter, seed) +
                        glm::vec3(-0.03F, 0.015F, 0.F);
        out.push_back(stroke);
      });
}

}  // namespace belvedere
