#include <algorithm>
#include <cmath>

#include "texture/strokes/class_strokes.h"
#include "texture/strokes/parcels.h"
#include "texture/strokes/stroke_parts.h"
#include "texture/strokes/stroke_trees.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float tree_width = 3.6F;   // units
constexpr float tree_height = 7.6F;  // units
constexpr float largest =
    1.95F;  // of any tree, times these: larger reaches are in stroke_table.cpp
constexpr float crown_m =
    26.0F;  // metres per unit at which trees have that size; nearer ones are larger
constexpr int longest_row = 3;  // trees down a rib

// Whether the ground at an offset in units from pixel i is open: glade, meadow or rock on the same
// slope.
bool is_open_at(const StrokeScene& scene, std::size_t i, glm::vec2 position) {
  if (!scene.on_canvas(position)) return false;
  const std::size_t there = scene.pixel(position);
  if (!on_same_slope(scene, i, there)) return false;
  return scene.class_at(there) != forest || is_grassy(scene, there);
}

// The look of a tree at the forest's edge: lit from the side that is open to the sun, dark against
// the open ground at its foot.
TreeTone edge_tone(const StrokeScene& scene, std::size_t i, glm::vec2 foot, float lighter) {
  const float side = scene.sun_side(i);
  const float unit = scene.scale();
  TreeTone tone{.lighter = lighter};
  if (is_open_at(scene, i, foot + glm::vec2(5.5F * side, -1.F) * unit)) tone.rim += 0.6F;
  if (is_open_at(scene, i, foot + glm::vec2(3.F * side, -4.F) * unit)) tone.rim += 0.4F;
  if (is_open_at(scene, i, foot + glm::vec2(-5.F * side, 1.F) * unit)) tone.edge += 0.5F;
  if (is_open_at(scene, i, foot + glm::vec2(0.F, 3.5F) * unit)) tone.edge += 0.5F;
  return tone;
}

float above_treeline_m(const StrokeScene& scene, std::size_t i) {
  return scene.altitude_m(i) - static_cast<float>(scene.parameters.treeline_m);
}

// Belts by altitude: broadleaf below, spruce, and open forest of larch and stone pine below the
// treeline. Trees of one kind form groups, so that belts interlock.
enum class TreeKind { spruce, leafy, larch, stone_pine };

// `group`: noise of deviation 1, with outliers.
TreeKind kind_of_group(const StrokeScene& scene, std::size_t i, float group) {
  const float above_m = above_treeline_m(scene, i);
  // The share s of the noise's values lies above about 2.5 (0.5 - s).
  const float leafy = 0.55F * std::clamp((-470.F - above_m) / 700.F, 0.F, 1.F);
  if (leafy > 0.02F && group > 2.5F * (0.5F - leafy)) return TreeKind::leafy;
  if (!(scene.parameters.larch_share > 0.0)) return TreeKind::spruce;
  const float high = std::clamp((above_m + 620.F) / 450.F, 0.F, 1.F);
  if (high > 0.02F && -group > 2.5F * (0.5F - 0.62F * high)) return TreeKind::larch;
  return above_m > -230.F && group > 0.3F ? TreeKind::stone_pine : TreeKind::spruce;
}

// Size of the trees at a position: tall in gullies and at low altitude, small towards the treeline
// and on ribs; whole stands have one age.
float crown_size_at(const StrokeScene& scene, std::size_t i) {
  const float age = std::clamp(patch_noise(scene, i, Stream::forest_masses, 30.0), -1.6F, 1.6F);
  const float gully = std::clamp(-scene.relief_m(i) / 10.F, -1.F, 1.F);
  const float stunted = std::clamp((above_treeline_m(scene, i) + 330.F) / 330.F, 0.F, 1.F);
  const float nearness =
      std::clamp(std::sqrt(std::sqrt(crown_m / scene.metres_per_unit(i))), 0.85F, 1.30F);
  return nearness * (1.F + 0.15F * age + 0.09F * gully) * (1.F - 0.24F * stunted);
}

// The canopy, deviation about 1: crowns of a group rise above the trees between.
float canopy_at(const StrokeScene& scene, std::size_t i) {
  return 0.75F * patch_noise(scene, i, Stream::forest_groups, 5.0) +
         0.65F * patch_noise(scene, i, Stream::forest_masses, 12.0);
}

// Slope of the canopy towards the sun: > 0 on the light side of a group, < 0 on its dark side.
float lit_side(const StrokeScene& scene, std::size_t i, glm::vec2 position, float canopy) {
  const float side = scene.sun_side(i);
  const glm::vec2 there = position + glm::vec2(4.5F * side, -2.F) * scene.scale();
  if (!scene.on_canvas(there)) return 0.F;
  const std::size_t k = scene.pixel(there);
  return on_same_slope(scene, i, k) ? std::clamp(canopy - canopy_at(scene, k), -1.4F, 1.4F) : 0.F;
}

// One tree of the forest at `foot`. `group`, -1…1, is its position inside a group: the tallest are
// in the centre.
void plant_in_forest(const StrokeScene& scene, glm::vec2 foot, std::size_t i, TreeKind kind,
                     TreeTone tone, float size, StrokeSeed& seed, std::vector<Stroke>& out) {
  const float scale = scene.scale();
  const float slim = seed.between(0.82F, 1.20F);
  const float grown = std::min(size * seed.between(0.70F, 1.22F), largest);
  const Tree tree{foot, tree_width * slim * grown * scale, tree_height * grown * scale};
  const TreeTone edge = edge_tone(scene, i, foot, tone.lighter);
  tone.rim = edge.rim;
  tone.edge = edge.edge;
  tone.calm *= 1.F - std::min(1.F, edge.rim + edge.edge);
  switch (kind) {
    case TreeKind::leafy:
      return plant_leafy(scene, {tree.foot, 1.2F * tree.width, 0.72F * tree.height}, i, tone, seed,
                         out);
    case TreeKind::larch:
      return plant_larch(scene, tree, i, tone, seed, out);
    case TreeKind::stone_pine:
      return plant_stone_pine(scene, tree, i, tone, seed, out);
    case TreeKind::spruce:
      return plant_spruce(scene, tree, i, tone, seed, out);
  }
}

}  // namespace

std::vector<Stroke> forest_trees(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 7.F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        if (scene.class_at(i) != forest) return;
        const float scale = scene.scale();
        // Groups have a light side and a dark one, and whole groups are lighter or darker, single
        // trees little: so a slope reads as masses of forest, not as fur.
        const float calm = 1.F - hand_busy_at(scene, position);
        const float mass =
            std::clamp(patch_noise(scene, i, Stream::forest_masses, 14.0), -1.6F, 1.6F);
        const float canopy = canopy_at(scene, i);
        const float group_tone = (0.10F + 0.08F * (1.F - calm)) * seed.normal() + 0.20F * mass +
                                 0.34F * lit_side(scene, i, position, canopy);
        const float strays = 0.22F * seed.normal();
        const TreeKind kind =
            kind_of_group(scene, i, patch_noise(scene, i, Stream::leafy_groups, 8.0) + strays);
        const float size =
            crown_size_at(scene, i) * (0.95F + 0.13F * std::clamp(canopy, -1.F, 1.F));
        // On steep ribs trees stand in rows down the slope, elsewhere in clusters.
        const bool in_row =
            seed.uniform() < 0.55F * std::clamp((scene.slope_deg(i) - 26.F) / 14.F, 0.F, 1.F);
        const int count = 2 + static_cast<int>(seed.uniform() * 4.F);
        glm::vec2 foot = position;
        for (int k = 0; k < (in_row ? std::min(count, longest_row) : count); ++k) {
          if (k > 0 && !in_row) {
            const float right =
                std::clamp(seed.normal(), -1.8F, 1.8F);  // drawn one by one: see stroke_seeds.h
            const float down = std::clamp(seed.normal(), -1.8F, 1.8F);
            foot = position + glm::vec2(4.2F * right, 3.4F * down) * scale;
          }
          if (!scene.on_canvas(foot)) break;
          const std::size_t here = scene.pixel(foot);
          if (scene.class_at(here) != forest || !on_same_slope(scene, i, here)) {
            if (in_row) break;
            continue;
          }
          if (!is_grassy(scene, here) && seed.uniform() < scene.base.tree_density[here]) {
            const float down = 0.6F * seed.normal();
            const float right = 0.6F * seed.normal();
            const float lighter = group_tone + (0.12F + 0.12F * (1.F - calm)) * seed.normal();
            plant_in_forest(scene, foot + glm::vec2(right, down) * scale, here, kind,
                            {.lighter = lighter, .calm = calm}, size, seed, out);
          }
          if (in_row) foot += scene.fall_line(foot) * (5.2F * seed.between(0.8F, 1.2F) * scale);
        }
      });
}

// Trees that form a wall where the forest ends at a meadow.
std::vector<Stroke> forest_edges(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.4F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.class_at(i) != forest || is_grassy(scene, i)) return;
               const glm::vec2 below = position + glm::vec2(0.F, 3.2F * scene.scale());
               if (!scene.on_canvas(below)) return;
               const std::size_t ground = scene.pixel(below);
               if (!on_same_slope(scene, i, ground) || !is_grassy(scene, ground) ||
                   scene.class_at(ground) == alpine_grass)
                 return;
               const float group = patch_noise(scene, i, Stream::forest_edge_groups, 5.0);
               if (seed.uniform() > 0.62F + 0.35F * group) return;
               const float lighter = 0.15F * seed.normal() - 0.2F;
               const TreeKind kind =
                   kind_of_group(scene, i, patch_noise(scene, i, Stream::leafy_groups, 8.0));
               plant_in_forest(scene, position, i, kind, {.lighter = lighter},
                               crown_size_at(scene, i), seed, out);
             });
}

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
