#include <algorithm>
#include <cmath>

#include "texture/parcels.h"
#include "texture/stroke_kinds.h"
#include "texture/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float tree_width = 3.7F;   // units
constexpr float tree_height = 7.8F;  // units

// Where a tree stands and how large it is, px.
struct Tree {
  glm::vec2 foot;
  float width;
  float height;
};

// One tree, dark side then lit side, with the smudge it casts away from the sun. `lighter` moves the whole tree's tone.
void plant(const StrokeScene& scene, const Tree& tree, std::size_t i, float lighter, StrokeSeed& seed, std::vector<Stroke>& out) {
  const float tone = scene.guidance.tone[i];
  const auto side = static_cast<float>(scene.parameters.sun_side);
  const float scale = scene.scale();
  Stroke stroke;
  stroke.depth_m = scene.guidance.depth_m[i];
  stroke.source = static_cast<std::uint32_t>(i);
  stroke.order = stroke.depth_m;
  stroke.gate = StrokeGate::upright;
  if (tone > 0.35F && seed.uniform() < 0.6F) {
    Stroke smudge = stroke;
    smudge.gate = StrokeGate::surface;
    set_line(smudge, tree.foot + glm::vec2(0.2F * side * tree.width, 0.F),
             tree.foot + glm::vec2(-1.1F * side * tree.width, 0.25F * tree.width), tree.width * 0.7F, tree.width * 0.3F);
    smudge.alpha = 0.45F;
    smudge.colour = scene.colour(i, -1.1F, paint_jitter * 0.5F, seed);
    out.push_back(smudge);
  }
  // Fractions of a metre of depth keep the parts of one tree in order without moving it between others.
  set_line(stroke, tree.foot, tree.foot + glm::vec2(0.2F * seed.normal() * scale, -tree.height), tree.width, tree.width * 0.35F);
  stroke.alpha = 0.85F;
  stroke.colour = scene.colour(i, -0.85F + lighter * 0.8F, paint_jitter, seed);
  stroke.order -= 0.5F;
  out.push_back(stroke);
  if (seed.uniform() < 0.9F) {
    Stroke lit = stroke;
    set_line(lit, tree.foot + glm::vec2(0.24F * side * tree.width, -0.25F * tree.height),
             tree.foot + glm::vec2(0.10F * side * tree.width, -0.95F * tree.height), tree.width * 0.40F, tree.width * 0.18F);
    lit.alpha = 0.35F + 0.55F * (0.25F + 0.75F * tone);
    lit.colour = scene.colour(i, 0.10F + 0.9F * tone + lighter, paint_jitter, seed);
    lit.order -= 0.5F;
    out.push_back(lit);
  }
  if (scene.parameters.winter && seed.uniform() < 0.5F) {
    // Snow lies on the branches of the sunny side; on the shady one it hardly shows, or the wood would look as in a flurry.
    Stroke dab = stroke;
    set_line(dab, tree.foot + glm::vec2(0.17F * side * tree.width, -0.50F * tree.height),
             tree.foot + glm::vec2(0.05F * side * tree.width, -0.95F * tree.height), tree.width * 0.46F, tree.width * 0.25F);
    dab.alpha = 0.16F + 0.42F * std::clamp(tone, 0.F, 1.F);
    const glm::vec3 snow_paint = fresh_snow(tone);
    dab.colour = snow_paint + (scene.ground.colour[i] - snow_paint) * 0.3F;
    dab.order -= 0.7F;
    out.push_back(dab);
  }
}

// Trees stand in groups with gaps of some 250 m and 900 m between, a pure function of the ground; deviation about .85.
float grouping(const StrokeScene& scene, std::size_t i) {
  return 0.6F * ground_noise(scene, i, 51, 120.0) + 0.6F * ground_noise(scene, i, 52, 420.0);
}

bool on_same_slope(const StrokeScene& scene, std::size_t here, std::size_t there) {
  return std::abs(scene.guidance.depth_m[there] / scene.guidance.depth_m[here] - 1.F) <= 0.03F;
}

// 1 on the borders of some fields, where hedges grow.
float hedge_at(const StrokeScene& scene, std::size_t i) {
  const glm::dvec3 p = glm::dvec3(scene.guidance.position_m[i]) + scene.guidance.origin_m;
  const Parcel parcel = parcel_at(scene.parameters.seed, p.x, p.y, scene.metres_per_unit(i));
  return parcel.border_m < 0.09F * parcel.width_m && parcel.hedged ? 1.F : 0.F;
}

// A leafy tree: a round crown on a short stem, its lit side dabbed with yellow.
void plant_leafy(const StrokeScene& scene, const Tree& tree, std::size_t i, float lighter, StrokeSeed& seed, std::vector<Stroke>& out) {
  const float tone = scene.guidance.tone[i];
  const auto side = static_cast<float>(scene.parameters.sun_side);
  Stroke body;
  body.depth_m = scene.guidance.depth_m[i];
  body.source = static_cast<std::uint32_t>(i);
  body.order = body.depth_m - 0.5F;
  body.gate = StrokeGate::upright;
  set_line(body, tree.foot, tree.foot + glm::vec2(0.F, -0.55F * tree.height), tree.width, tree.width * 0.9F);
  body.alpha = 0.82F;
  body.colour = scene.colour(i, -0.9F + 0.7F * lighter, paint_jitter, seed);
  out.push_back(body);
  Stroke lit = body;
  const glm::vec2 crown = tree.foot + glm::vec2(0.20F * side * tree.width, -0.60F * tree.height);
  set_line(lit, crown, crown + glm::vec2(-0.02F * side * tree.width, -0.18F * tree.height), tree.width * 0.55F, tree.width * 0.4F);
  lit.alpha = 0.4F + 0.45F * tone;
  lit.colour = scene.colour(i, 0.2F + 0.9F * tone + lighter, paint_jitter, seed) + glm::vec3(0.045F, 0.025F, -0.045F) * tone;
  lit.order -= 0.5F;
  out.push_back(lit);
  if (tone > 0.4F && seed.uniform() < 0.55F) {
    Stroke dot = lit;
    const glm::vec2 at = crown + glm::vec2(seed.between(-0.2F, 0.2F) * tree.width, -0.15F * tree.height);
    set_line(dot, at, at - glm::vec2(0.F, 0.12F * tree.width), tree.width * 0.28F, tree.width * 0.2F);
    dot.alpha = 0.7F;
    dot.colour = lit.colour + (1.F - std::min(1.F, scene.ground.haze[i])) * glm::vec3(0.13F, 0.09F, -0.06F) * tone;
    dot.order -= 0.5F;
    out.push_back(dot);
  }
}

// How many of the trees are leafy: the lower, the more; none from 1350 m on, none in winter's snow.
float leafy_share(const StrokeScene& scene, std::size_t i) {
  return scene.parameters.winter ? 0.F : 0.55F * std::clamp((1350.F - scene.altitude_m(i)) / 700.F, 0.F, 1.F);
}

}  // namespace

std::vector<Stroke> forest_trees(const StrokeScene& scene) {
  return sow(scene, 7.F, 11, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != forest) return;
    const float scale = scene.scale();
    const float group = grouping(scene, i);
    // Whole groups are lighter or darker, single trees little: then a slope reads as masses of wood, not as fur.
    const float row_tone = 0.22F * seed.normal() + 0.20F * std::clamp(group, -1.5F, 1.5F);
    const float leafy = leafy_share(scene, i) * std::clamp(1.F + 0.9F * sheet_noise(scene, place, 64, 18.0), 0.F, 2.F);
    const bool leafy_row = seed.uniform() < leafy;
    const int count = 2 + static_cast<int>(seed.uniform() * 4.F);
    const float thin = std::clamp(0.34F * (-group - 0.5F), 0.F, 0.50F);
    glm::vec2 foot = place;
    for (int k = 0; k < count && scene.on_canvas(foot); ++k) {
      const std::size_t here = scene.pixel(foot);
      if (scene.class_at(here) != forest || !on_same_slope(scene, i, here)) break;
      if (seed.uniform() < scene.ground.tree_density[here] - thin) {
        const float down = seed.normal();  // drawn one by one: see stroke_seeds.h
        const float right = seed.normal();
        const float width = tree_width * seed.between(0.75F, 1.25F) * scale;
        const Tree tree{foot + glm::vec2(right, down) * 0.6F * scale, width, tree_height * seed.between(0.7F, 1.3F) * scale};
        const float tone = row_tone + 0.20F * seed.normal();
        if (leafy_row)
          plant_leafy(scene, {tree.foot, 1.15F * tree.width, 0.75F * tree.height}, here, tone, seed, out);
        else
          plant(scene, tree, here, tone, seed, out);
      }
      foot += scene.fall_line(foot) * (5.2F * seed.between(0.8F, 1.2F) * scale);
    }
  });
}

std::vector<Stroke> scattered_trees(const StrokeScene& scene) {
  return sow(scene, 4.2F, 12, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if (!is_grass(id) || id == shrub) return;
    const auto is = [&](LandCoverClass wanted) { return [&scene, wanted](std::size_t k) { return scene.class_at(k) == wanted; }; };
    const float group = grouping(scene, i);
    // Outposts before the forest, copses in the open, rows along brooks and hedges; the rest is bare.
    const float before_forest = share_around(scene, place, 7.F, is(forest));
    float share = 0.012F * std::clamp(group - 0.5F, 0.F, 2.F) + 0.10F * before_forest;
    if (id == alpine_grass) share = before_forest > 0.F ? 0.16F * before_forest : 0.F;
    if (id == pasture || id == valley_floor) share += 0.40F * std::clamp(group - 1.15F, 0.F, 0.8F);
    if (id == valley_floor) {
      if (share_around(scene, place, 3.2F, is(water)) > 0.F) share += 0.16F + 0.25F * std::clamp(0.5F + group, 0.F, 1.F);
      share += 0.35F * hedge_at(scene, i) * std::clamp(0.3F + 0.8F * group, 0.F, 1.F);
      share += 0.10F * share_around(scene, place, 6.F, is(settlement));
    }
    if (seed.uniform() > 0.42F * share) return;
    // One to five together, in a row along the contour or huddled; a lone tree is the exception.
    const float scale = scene.scale();
    const int count = 1 + static_cast<int>(seed.uniform() * 4.6F);
    const bool spruces = id == alpine_grass || scene.parameters.winter || seed.uniform() < 0.25F + 0.4F * before_forest;
    glm::vec2 foot = place;
    for (int k = 0; k < count; ++k) {
      if (k > 0) {
        const float aside = seed.between(1.3F, 2.6F) * (seed.uniform() < 0.7F ? 1.F : -1.F);
        foot += glm::vec2(aside, 0.7F * seed.normal()) * scale;
      }
      if (!scene.on_canvas(foot)) break;
      const std::size_t here = scene.pixel(foot);
      if (!is_grass(scene.class_at(here)) || !on_same_slope(scene, i, here)) break;
      const float width = 2.6F * scale * seed.between(0.6F, 1.35F);
      const float lighter = 0.2F * seed.normal() - 0.35F;
      std::vector<Stroke> tree;
      if (spruces)
        plant(scene, {foot, width, 2.0F * width}, here, lighter, seed, tree);
      else
        plant_leafy(scene, {foot, 1.2F * width, 1.35F * width}, here, lighter, seed, tree);
      // They stand on grass, whose colours they would take: trees are darker and bluer than it.
      const glm::vec3 leaves = through_air_factor(scene, here, glm::vec3(0.62F, 0.76F, 0.82F));
      for (Stroke& stroke : tree) {
        if (stroke.gate == StrokeGate::upright) stroke.colour *= leaves;
        out.push_back(stroke);
      }
    }
  });
}

std::vector<Stroke> low_bushes(const StrokeScene& scene) {
  return sow(scene, 4.2F, 13, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if ((id != alpine_grass && id != shrub) || seed.uniform() > scene.ground.tree_density[i]) return;
    const float scale = scene.scale();
    const float width = 2.6F * scale * seed.between(0.6F, 1.4F);
    Stroke stroke;
    stroke.depth_m = scene.guidance.depth_m[i];
    stroke.source = static_cast<std::uint32_t>(i);
    stroke.order = stroke.depth_m - 0.5F;
    stroke.gate = StrokeGate::upright;
    set_line(stroke, place - glm::vec2(0.4F * width, 0.F), place + glm::vec2(0.5F * width, -0.4F * scale), width, width * 0.7F);
    stroke.alpha = 0.7F;
    stroke.colour = scene.colour(i, -seed.between(1.2F, 1.4F), paint_jitter, seed) + glm::vec3(-0.03F, 0.015F, 0.F);
    out.push_back(stroke);
  });
}

}  // namespace belvedere
