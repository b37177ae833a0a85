#include <algorithm>
#include <cmath>

#include "texture/strokes/stroke_kinds.h"
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

}  // namespace belvedere
