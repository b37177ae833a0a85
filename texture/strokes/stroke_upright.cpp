#include <algorithm>
#include <cmath>

#include "texture/strokes/parcels.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"
#include "texture/strokes/stroke_trees.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float tree_width = 3.7F;   // units
constexpr float tree_height = 7.8F;  // units

bool on_same_slope(const StrokeScene& scene, std::size_t here, std::size_t there) {
  return std::abs(scene.guidance.depth_m[there] / scene.guidance.depth_m[here] - 1.F) <= 0.03F;
}

// Whether the ground at a place some units from pixel i lies open: glade, meadow or rock on the same slope.
bool is_open_at(const StrokeScene& scene, std::size_t i, glm::vec2 place) {
  if (!scene.on_canvas(place)) return false;
  const std::size_t there = scene.pixel(place);
  if (!on_same_slope(scene, i, there)) return false;
  return scene.class_at(there) != forest || is_grassy(scene, there);
}

// What a tree of the forest's edge looks like: lit from the side that is open to the sun, dark before the open ground at its foot.
TreeTone edge_tone(const StrokeScene& scene, std::size_t i, glm::vec2 foot, float lighter) {
  const auto side = static_cast<float>(scene.parameters.sun_side);
  const float unit = scene.scale();
  TreeTone tone{lighter, 0.F, 0.F};
  if (is_open_at(scene, i, foot + glm::vec2(5.5F * side, -1.F) * unit)) tone.rim += 0.6F;
  if (is_open_at(scene, i, foot + glm::vec2(3.F * side, -4.F) * unit)) tone.rim += 0.4F;
  if (is_open_at(scene, i, foot + glm::vec2(-5.F * side, 1.F) * unit)) tone.edge += 0.5F;
  if (is_open_at(scene, i, foot + glm::vec2(0.F, 3.5F) * unit)) tone.edge += 0.5F;
  return tone;
}

// Share of trees that are leafy where a group of noise `group` (deviation 1) stands: the lower, the more groups; none from 1350 m on.
bool is_leafy(const StrokeScene& scene, std::size_t i, float group) {
  const float share = 0.55F * std::clamp((1350.F - scene.altitude_m(i)) / 700.F, 0.F, 1.F);
  return share > 0.02F && group > 2.5F * (0.5F - share);
}

// 1 on the borders of some fields, where hedges grow.
float hedge_at(const StrokeScene& scene, std::size_t i) {
  const glm::dvec3 p = glm::dvec3(scene.guidance.position_m[i]) + scene.guidance.origin_m;
  const Parcel parcel = parcel_at(scene.parameters.seed, p.x, p.y, scene.metres_per_unit(i), scene.guidance.grain[i]);
  return parcel.border_m < 0.09F * parcel.width_m && parcel.hedged ? 1.F : 0.F;
}

// One tree of the forest at `foot`, spruce or leafy. `group` 0…1 is how far it stands inside a group: the tallest stand in the middle.
void plant_in_forest(const StrokeScene& scene, glm::vec2 foot, std::size_t i, bool leafy, float lighter, float group, StrokeSeed& seed,
                     std::vector<Stroke>& out) {
  const float scale = scene.scale();
  const float slim = seed.between(0.80F, 1.20F);
  const float size = seed.between(0.72F, 1.18F) * (0.90F + 0.22F * group);
  const Tree tree{foot, tree_width * slim * size * scale, tree_height * size * scale};
  const TreeTone tone = edge_tone(scene, i, foot, lighter);
  if (leafy)
    plant_leafy(scene, {tree.foot, 1.2F * tree.width, 0.72F * tree.height}, i, tone, seed, out);
  else
    plant_spruce(scene, tree, i, tone, seed, out);
}

}  // namespace

std::vector<Stroke> forest_trees(const StrokeScene& scene, Stream stream) {
  return sow(scene, 7.F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != forest) return;
    const float scale = scene.scale();
    // Whole groups are lighter or darker, single trees little: then a slope reads as masses of wood, not as fur.
    const float mass = patch_noise(scene, i, Stream::forest_masses, 14.0);
    const float group = patch_noise(scene, i, Stream::forest_groups, 5.0);
    const float row_tone = 0.18F * seed.normal() + 0.22F * std::clamp(mass, -1.6F, 1.6F);
    const float strays = 0.22F * seed.normal();
    const bool leafy = is_leafy(scene, i, patch_noise(scene, i, Stream::leafy_groups, 8.0) + strays);
    const int count = 2 + static_cast<int>(seed.uniform() * 4.F);
    glm::vec2 foot = place;
    for (int k = 0; k < count && scene.on_canvas(foot); ++k) {
      const std::size_t here = scene.pixel(foot);
      if (scene.class_at(here) != forest || !on_same_slope(scene, i, here)) break;
      if (!is_grassy(scene, here) && seed.uniform() < scene.base.tree_density[here]) {
        const float down = seed.normal();  // drawn one by one: see stroke_seeds.h
        const float right = seed.normal();
        const float tone = row_tone + 0.22F * seed.normal();
        plant_in_forest(scene, foot + glm::vec2(right, down) * 0.6F * scale, here, leafy, tone, std::clamp(group, -1.F, 1.F), seed, out);
      }
      foot += scene.fall_line(foot) * (5.2F * seed.between(0.8F, 1.2F) * scale);
    }
  });
}

// Trees that stand like a wall where the forest ends on meadow.
std::vector<Stroke> forest_edges(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.4F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != forest || is_grassy(scene, i)) return;
    const glm::vec2 below = place + glm::vec2(0.F, 3.2F * scene.scale());
    if (!scene.on_canvas(below)) return;
    const std::size_t ground = scene.pixel(below);
    if (!on_same_slope(scene, i, ground) || !is_grassy(scene, ground) || scene.class_at(ground) == alpine_grass) return;
    const float group = patch_noise(scene, i, Stream::forest_edge_groups, 5.0);
    if (seed.uniform() > 0.62F + 0.35F * group) return;
    const float lighter = 0.15F * seed.normal() - 0.2F;
    plant_in_forest(scene, place, i, is_leafy(scene, i, patch_noise(scene, i, Stream::leafy_groups, 8.0)), lighter, 0.F, seed, out);
  });
}

// Grass of the glades, over whatever lies there: short strokes down the slope and across it.
std::vector<Stroke> glade_grass(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.6F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != forest || !is_grassy(scene, i)) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.order += 2.F;  // before the trees around
    const float turn = seed.uniform() < 0.5F ? 0.F : quarter_turn;
    const float length = seed.between(4.F, 9.F);
    lay_line(stroke, scene, place, length, turn + 0.3F * seed.normal(), 0.2F, true, seed);
    take_brush(stroke, scene, seed.between(1.6F, 2.8F), {.taper = 0.5F, .alpha = 0.6F, .bristle = 0.4F, .wetness = 0.03F});
    stroke.colour = scene.colour(i, mixed_tone(0.28F, 0.20F, seed), paint_jitter * 1.3F, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> scattered_trees(const StrokeScene& scene, Stream stream) {
  return sow(scene, 4.2F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if (!has_trait(id, ClassTrait::lone_trees)) return;
    const auto is = [&](LandCoverClass asked) { return [&scene, asked](std::size_t k) { return scene.class_at(k) == asked; }; };
    // Stretches along brooks and fields that are planted, and places where copses stand; between them the land is bare.
    const float stretch = patch_noise(scene, i, Stream::tree_stretches, 12.0);
    const float copse = patch_noise(scene, i, Stream::copses, 5.0);
    const float before_forest = share_around(scene, place, 7.F, is(forest));
    float share = 0.F;
    int most = 3;
    if (id == alpine_grass) {
      const float outpost = 0.14F * share_around(scene, place, 15.F, is(forest));
      share = (0.30F * before_forest + outpost) * std::clamp(0.4F + 0.8F * copse, 0.F, 1.5F);
    } else {
      share = 0.22F * before_forest * std::clamp(0.2F + copse, 0.F, 1.F);
      if (copse > 1.9F) {
        share += 0.40F;
        most = 6;
      } else if (stretch > 0.8F) {
        share += 0.004F;  // a lone tree
      }
    }
    if (id == valley_floor) {
      const bool bank = share_around(scene, place, 3.2F, is(water)) > 0.F;
      if (bank) share += 0.75F * std::clamp(0.2F + 0.9F * stretch, 0.03F, 1.F);
      share += 0.42F * hedge_at(scene, i) * std::clamp(0.9F * stretch - 0.2F, 0.F, 1.F);
      share += 0.06F * share_around(scene, place, 6.F, is(settlement));
    }
    if (seed.uniform() > share) return;
    const float scale = scene.scale();
    const float crowd = seed.uniform();
    const int count = 1 + static_cast<int>(crowd * crowd * static_cast<float>(most));
    const bool spruces = id == alpine_grass || seed.uniform() < 0.2F + 0.5F * before_forest;
    const float size = seed.between(0.7F, 1.1F);
    glm::vec2 foot = place;
    for (int k = 0; k < count; ++k) {
      if (k > 0) {
        // Huddled: crowns touch, and each stands a little nearer or farther than the last.
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
      // They stand on grass, whose colours they would take: leaves are darker and greener than it.
      const glm::vec3 leaves = scene.parameters.winter ? through_air_factor(scene, here, glm::vec3(0.60F, 0.66F, 0.74F))
                                                       : through_air_factor(scene, here, glm::vec3(0.70F, 0.84F, 0.74F));
      for (Stroke& stroke : tree) {
        if (stroke.gate == StrokeGate::upright) stroke.colour *= leaves;
        out.push_back(stroke);
      }
    }
  });
}

std::vector<Stroke> low_bushes(const StrokeScene& scene, Stream stream) {
  return sow(scene, 4.2F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if ((id != alpine_grass && id != shrub) || seed.uniform() > scene.base.tree_density[i]) return;
    const float scale = scene.scale();
    const float width = 2.6F * scale * seed.between(0.6F, 1.4F);
    Stroke stroke = standing_stroke(scene, i);
    stroke.order = stroke.depth_m - 0.5F;
    stroke.gate = StrokeGate::upright;
    set_line(stroke, place - glm::vec2(0.4F * width, 0.F), place + glm::vec2(0.5F * width, -0.4F * scale), width, width * 0.7F);
    stroke.alpha = 0.7F;
    stroke.colour = scene.colour(i, -seed.between(1.2F, 1.4F), paint_jitter, seed) + glm::vec3(-0.03F, 0.015F, 0.F);
    out.push_back(stroke);
  });
}

}  // namespace belvedere
