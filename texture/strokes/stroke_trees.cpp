#include "texture/strokes/stroke_trees.h"

#include <algorithm>

#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

// The dark sides of trees: darker and bluer than the forest floor, more so on bright slopes, where
// trees would otherwise be lost in light.
constexpr glm::vec3 dark_leaves{0.56F, 0.68F, 0.84F};

Stroke upright_stroke(const StrokeScene& scene, std::size_t i) {
  Stroke stroke = standing_stroke(scene, i);
  // Fractions of a metre of depth keep the parts of one tree in order without mixing them with
  // other trees.
  stroke.order = stroke.depth_m - 0.5F;
  stroke.gate = StrokeGate::upright;
  return stroke;
}

glm::vec3 dark_side(const StrokeScene& scene, std::size_t i, const TreeTone& tone,
                    StrokeSeed& seed) {
  const float light = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  const float depth =
      std::clamp(0.30F + 0.70F * light + 0.25F * tone.edge - 0.38F * tone.calm, 0.F, 1.F);
  const glm::vec3 paint = scene.colour(i, -0.80F + 0.6F * tone.lighter, paint_jitter, seed);
  return paint * through_air_factor(scene, i, 1.F + (dark_leaves - 1.F) * depth);
}

// The effect of a tree on the ground: inside the forest a broad dark dab at its foot, where little
// light arrives, so that the crowns stand out; on open ground a shadow away from the sun.
void shade_ground(const StrokeScene& scene, const Tree& tree, std::size_t i, const TreeTone& tone,
                  StrokeSeed& seed, std::vector<Stroke>& out) {
  const float light = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  const float side = scene.sun_side(i);
  Stroke shade = upright_stroke(scene, i);
  shade.gate = StrokeGate::surface;
  shade.order = shade.depth_m + 1.F;
  const float u = seed.uniform();
  if (u < tone.edge) {
    if (light < 0.35F) return;
    set_line(shade, tree.foot + glm::vec2(0.2F * side * tree.width, -0.1F * tree.width),
             tree.foot + glm::vec2(-1.6F * side * tree.width, 0.25F * tree.width),
             tree.width * 0.7F, tree.width * 0.3F);
    shade.alpha = 0.30F + 0.35F * light;
    shade.order = shade.depth_m;
  } else {
    set_line(shade, tree.foot + glm::vec2(0.F, 0.1F * tree.width),
             tree.foot - glm::vec2(0.4F * side * tree.width, 0.5F * tree.height), tree.width * 1.5F,
             tree.width * 1.2F);
    shade.alpha = 0.40F + 0.22F * light;
  }
  shade.colour = dark_side(scene, i, {.lighter = -0.3F}, seed);
  out.push_back(shade);
}

// The colour of a group of leafy trees, from the palette, and how far it is taken.
struct Leaves {
  glm::vec3 colour{0.F};
  float share = 0.F;
};

Leaves leaves_at(const StrokeScene& scene, std::size_t i, StrokeSeed& seed) {
  const std::vector<glm::vec3>& colours = scene.parameters.leaves;
  const float stray = seed.normal();
  if (colours.empty()) return {};
  const auto count = static_cast<float>(colours.size());
  const float position =
      0.5F + 0.33F * patch_noise(scene, i, Stream::leaf_colours, 7.0) + 0.12F * stray;
  const auto chosen = static_cast<std::size_t>(std::clamp(position * count, 0.F, count - 1.F));
  // Warm leaves shine in the sun; in the shade all forest has the same blue.
  const float light = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  return {colours[chosen],
          static_cast<float>(scene.parameters.leaf_share) * (0.25F + 0.75F * light)};
}

// Conifers differ in the bluntness of their tips, and in whether they have a colour of their own.
struct Needles {
  float tip = 0.10F;        // width at the tip, relative to that at the foot
  float lit_width = 0.44F;  // of the light side
  glm::vec3 colour{0.F};    // in full light, encoded sRGB …
  float share = 0.F;        // … and how far the tree takes it, 0…1
};

void plant_needles(const StrokeScene& scene, const Tree& tree, std::size_t i, const TreeTone& tone,
                   const Needles& needles, StrokeSeed& seed, std::vector<Stroke>& out) {
  const float light = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  const float side = scene.sun_side(i);
  shade_ground(scene, tree, i, tone, seed, out);
  // The lowest branches spread at the foot, not below it.
  const glm::vec2 foot = tree.foot - glm::vec2(0.F, 0.25F * tree.width);
  const glm::vec2 tip = tree.foot + glm::vec2(0.10F * seed.normal() * scene.scale(), -tree.height);
  Stroke body = upright_stroke(scene, i);
  set_line(body, foot, tip, tree.width, tree.width * needles.tip);
  body.alpha = 0.90F - 0.04F * tone.calm;
  body.colour = dark_side(scene, i, tone, seed);
  if (needles.share > 0.F)
    body.colour += 0.75F * needles.share *
                   (through_air(scene, i, needles.colour * (0.42F + 0.20F * light)) - body.colour);
  out.push_back(body);
  // In the shade the sky lights trees a little from all sides; in the sun nearly every tree has a
  // light side.
  if (seed.uniform() < 0.62F + 0.33F * light) {
    Stroke lit = body;
    set_line(lit, foot + glm::vec2(0.24F * side * tree.width, -0.10F * tree.height),
             tip + glm::vec2(0.10F * side * tree.width, 0.07F * tree.height),
             tree.width * needles.lit_width, tree.width * needles.tip);
    lit.alpha =
        std::min(0.95F, (0.34F + 0.50F * light + 0.15F * tone.rim) * (1.F - 0.60F * tone.calm));
    const float warm = light * light * (0.6F + 0.8F * tone.rim);
    lit.colour =
        scene.colour(i, std::min(1.5F, 1.30F * light - 0.05F + tone.lighter + 0.5F * tone.rim),
                     paint_jitter, seed);
    lit.colour +=
        (1.F - std::min(1.F, scene.base.haze[i])) * warm * glm::vec3(0.060F, 0.040F, -0.030F);
    if (needles.share > 0.F)
      lit.colour +=
          needles.share *
          (through_air(scene, i, needles.colour * (0.60F + 0.45F * light + 0.1F * tone.lighter)) -
           lit.colour);
    lit.order -= 0.5F;
    out.push_back(lit);
  }
  if (scene.parameters.winter && seed.uniform() < 0.5F) {
    // Snow lies on the branches of the sunny side; on the shady one it is hardly visible, because
    // the forest would look as in a flurry.
    Stroke dab = body;
    set_line(dab, tree.foot + glm::vec2(0.17F * side * tree.width, -0.50F * tree.height),
             tree.foot + glm::vec2(0.05F * side * tree.width, -0.90F * tree.height),
             tree.width * 0.42F, tree.width * 0.16F);
    dab.alpha = 0.16F + 0.42F * light;
    const glm::vec3 snow_paint = fresh_snow(light);
    dab.colour = snow_paint + (scene.base.colour[i] - snow_paint) * 0.3F;
    dab.order -= 0.7F;
    out.push_back(dab);
  }
}

}  // namespace

void plant_spruce(const StrokeScene& scene, const Tree& tree, std::size_t i, const TreeTone& tone,
                  StrokeSeed& seed, std::vector<Stroke>& out) {
  plant_needles(scene, tree, i, tone, {}, seed, out);
}

void plant_larch(const StrokeScene& scene, const Tree& tree, std::size_t i, const TreeTone& tone,
                 StrokeSeed& seed, std::vector<Stroke>& out) {
  const float light = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  const auto share = static_cast<float>(scene.parameters.larch_share) * (0.35F + 0.65F * light);
  plant_needles(
      scene, {tree.foot, 0.92F * tree.width, tree.height}, i, tone,
      {.tip = 0.16F, .lit_width = 0.56F, .colour = scene.parameters.larch, .share = share}, seed,
      out);
}

void plant_stone_pine(const StrokeScene& scene, const Tree& tree, std::size_t i,
                      const TreeTone& tone, StrokeSeed& seed, std::vector<Stroke>& out) {
  plant_needles(scene, {tree.foot, 1.1F * tree.width, 0.8F * tree.height}, i,
                {tone.lighter - 0.2F, tone.rim, tone.edge, tone.calm},
                {.tip = 0.42F, .lit_width = 0.50F}, seed, out);
}

void plant_leafy(const StrokeScene& scene, const Tree& tree, std::size_t i, const TreeTone& tone,
                 StrokeSeed& seed, std::vector<Stroke>& out) {
  const float light = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  const float clear = 1.F - std::min(1.F, scene.base.haze[i]);
  const float side = scene.sun_side(i);
  const bool bare = scene.parameters.winter;
  const Leaves leaves = leaves_at(scene, i, seed);
  shade_ground(scene, tree, i, tone, seed, out);
  Stroke body = upright_stroke(scene, i);
  const glm::vec2 stem = tree.foot - glm::vec2(0.F, 0.25F * tree.width);
  set_line(body, stem,
           stem - glm::vec2(0.F, std::max(0.3F * tree.width, tree.height - 0.8F * tree.width)),
           tree.width * 0.85F, tree.width);
  body.alpha = bare ? 0.6F : 0.88F;
  body.colour = dark_side(scene, i, {tone.lighter + 0.3F, tone.rim, tone.edge, tone.calm}, seed);
  body.colour += 0.6F * leaves.share *
                 (through_air(scene, i, leaves.colour * (0.42F + 0.18F * light)) - body.colour);
  out.push_back(body);
  const glm::vec2 crown = body.points[1];
  Stroke lit = body;
  set_line(lit, crown + glm::vec2(0.22F * side * tree.width, 0.12F * tree.width),
           crown + glm::vec2(0.14F * side * tree.width, -0.22F * tree.width), tree.width * 0.52F,
           tree.width * 0.44F);
  lit.alpha = bare ? 0.5F : std::min(0.95F, 0.42F + 0.45F * light + 0.1F * tone.rim);
  lit.colour = scene.colour(
      i, std::min(1.5F, 0.25F + 1.1F * light + tone.lighter + 0.4F * tone.rim), paint_jitter, seed);
  lit.colour += glm::vec3(0.045F, 0.032F, -0.045F) * (light * clear);
  lit.colour +=
      leaves.share * (through_air(scene, i, leaves.colour * (0.55F + 0.5F * light)) - lit.colour);
  lit.order -= 0.5F;
  out.push_back(lit);
  const int dots = light > 0.4F && !bare ? static_cast<int>(seed.uniform() * 1.35F) : 0;
  for (int k = 0; k < dots; ++k) {
    Stroke dot = lit;
    const float aside = seed.between(-0.10F, 0.38F) * side;
    const float up = seed.between(-0.30F, 0.20F);
    const glm::vec2 at = crown + glm::vec2(aside, up) * tree.width;
    set_line(dot, at, at - glm::vec2(0.F, 0.12F * tree.width), tree.width * 0.26F,
             tree.width * 0.2F);
    dot.alpha = 0.75F;
    dot.colour = lit.colour + clear * light * glm::vec3(0.13F, 0.11F, -0.06F);
    dot.order -= 0.5F;
    out.push_back(dot);
  }
}

}  // namespace belvedere
