#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/base/noise.h"
#include "texture/stroke_kinds.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float jitter = 0.018F;
constexpr float tree_width = 3.7F;   // units
constexpr float tree_height = 7.8F;  // units

// Where a tree stands and how large it is, px.
struct Tree {
  glm::vec2 foot;
  float width;
  float height;
};

// A straight tapered stroke between two places.
void set_line(Stroke& stroke, glm::vec2 from, glm::vec2 to, float start_width, float end_width) {
  stroke.points[0] = from;
  stroke.points[1] = to;
  stroke.point_count = 2;
  stroke.start_width = start_width;
  stroke.end_width = end_width;
}

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
    smudge.colour = scene.colour(i, -1.1F, jitter * 0.5F, seed);
    out.push_back(smudge);
  }
  // Fractions of a metre of depth keep the parts of one tree in order without moving it between others.
  set_line(stroke, tree.foot, tree.foot + glm::vec2(0.2F * seed.normal() * scale, -tree.height), tree.width, tree.width * 0.35F);
  stroke.alpha = 0.85F;
  stroke.colour = scene.colour(i, -0.85F + lighter * 0.8F, jitter, seed);
  stroke.order -= 0.5F;
  out.push_back(stroke);
  if (seed.uniform() < 0.9F) {
    Stroke lit = stroke;
    set_line(lit, tree.foot + glm::vec2(0.24F * side * tree.width, -0.25F * tree.height),
             tree.foot + glm::vec2(0.10F * side * tree.width, -0.95F * tree.height), tree.width * 0.40F, tree.width * 0.18F);
    lit.alpha = 0.35F + 0.55F * (0.25F + 0.75F * tone);
    lit.colour = scene.colour(i, 0.10F + 0.9F * tone + lighter, jitter, seed);
    lit.order -= 0.5F;
    out.push_back(lit);
  }
  if (scene.parameters.winter && seed.uniform() < 0.55F) {
    // Snow lies on the branches: white in the sun, bluish in shadow, a quarter into the air.
    Stroke dab = stroke;
    set_line(dab, tree.foot + glm::vec2(0.15F * side * tree.width, -0.45F * tree.height),
             tree.foot + glm::vec2(0.05F * side * tree.width, -0.95F * tree.height), tree.width * 0.55F, tree.width * 0.3F);
    dab.alpha = 0.55F;
    const float sunny = 0.55F + 0.4F * tone;
    const glm::vec3 snow_paint{0.55F + 0.42F * tone * sunny, 0.62F + 0.34F * tone * sunny, 0.78F + 0.17F * tone};
    dab.colour = snow_paint + (scene.ground.colour[i] - snow_paint) * 0.25F;
    dab.order -= 0.7F;
    out.push_back(dab);
  }
}

// Forest is nowhere equally dense: openings and thick groups of some 250 m, a pure function of the ground.
float grouping(const StrokeScene& scene, std::size_t i) {
  const glm::dvec3 p = glm::dvec3(scene.guidance.position_m[i]) + scene.guidance.origin_m;
  return static_cast<float>(gaussian_noise(scene.parameters.seed + 51, p.x, p.y, 120.0) * 0.6 +
                            gaussian_noise(scene.parameters.seed + 52, p.x, p.y, 420.0) * 0.6);
}

}  // namespace

std::vector<Stroke> forest_trees(const StrokeScene& scene) {
  return sow(scene, 7.F, 11, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != forest) return;
    const float scale = scene.scale();
    const float row_tone = 0.35F * seed.normal();
    const int count = 2 + static_cast<int>(seed.uniform() * 4.F);
    const float thin = std::clamp(0.25F * (-grouping(scene, i) - 0.6F), 0.F, 0.35F);
    glm::vec2 foot = place;
    for (int k = 0; k < count && scene.on_canvas(foot); ++k) {
      const std::size_t here = scene.pixel(foot);
      if (scene.class_at(here) != forest || std::abs(scene.guidance.depth_m[here] / scene.guidance.depth_m[i] - 1.F) > 0.03F) break;
      if (seed.uniform() < scene.ground.tree_density[here] - thin) {
        const float down = seed.normal();  // drawn one by one: see stroke_seeds.h
        const float right = seed.normal();
        const Tree tree{foot + glm::vec2(right, down) * 0.6F * scale, tree_width * seed.between(0.75F, 1.25F) * scale,
                        tree_height * seed.between(0.7F, 1.3F) * scale};
        plant(scene, tree, here, row_tone + 0.25F * seed.normal(), seed, out);
      }
      foot += scene.fall_line(foot) * (5.2F * seed.between(0.8F, 1.2F) * scale);
    }
  });
}

std::vector<Stroke> scattered_trees(const StrokeScene& scene) {
  return sow(scene, 4.2F, 12, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if (id != valley_floor && id != pasture) return;
    // In groups and rows rather than evenly strewn.
    const float share = (id == valley_floor ? 0.05F : 0.035F) * std::clamp(1.F + 1.1F * grouping(scene, i), 0.1F, 3.F);
    if (seed.uniform() > share) return;
    const float width = 2.4F * scene.scale() * seed.between(0.7F, 1.3F);
    Stroke stroke;
    stroke.depth_m = scene.guidance.depth_m[i];
    stroke.source = static_cast<std::uint32_t>(i);
    stroke.order = stroke.depth_m - 0.5F;
    stroke.gate = StrokeGate::upright;
    set_line(stroke, place, place + glm::vec2(0.3F * scene.scale(), -1.2F * width), width, width * 0.6F);
    stroke.alpha = 0.75F;
    // Leafy trees are darker and bluer than the grass they stand on.
    stroke.colour = scene.colour(i, -1.5F, jitter, seed) * glm::vec3(0.72F, 0.86F, 0.95F);
    stroke.colour += (scene.ground.colour[i] - stroke.colour) * (0.6F * scene.ground.haze[i]);
    out.push_back(stroke);
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
    stroke.colour = scene.colour(i, -seed.between(1.2F, 1.4F), jitter, seed) + glm::vec3(-0.03F, 0.015F, 0.F);
    out.push_back(stroke);
  });
}

std::vector<Stroke> houses(const StrokeScene& scene) {
  // Walls, roofs, slate (look/recipe.md), and how often each.
  static const std::array<glm::vec3, 3> paints = {glm::vec3(0.93F, 0.89F, 0.80F), glm::vec3(0.74F, 0.45F, 0.33F),
                                                  glm::vec3(0.42F, 0.44F, 0.48F)};
  return sow(scene, 3.4F, 14, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    // Quarters: dense cores and loose edges instead of one even sprinkle.
    if (scene.class_at(i) != settlement || seed.uniform() > std::clamp(0.62F + 0.22F * grouping(scene, i), 0.2F, 0.95F)) return;
    const float width = seed.between(1.F, 2.F) * scene.scale();
    Stroke stroke;
    stroke.depth_m = scene.guidance.depth_m[i];
    stroke.source = static_cast<std::uint32_t>(i);
    stroke.order = stroke.depth_m - 1.F;
    set_line(stroke, place - glm::vec2(0.7F * width, 0.F), place + glm::vec2(0.7F * width, 0.F), width, width);
    stroke.alpha = 0.85F;
    const float u = seed.uniform();
    const glm::vec3 paint = paints[u < 0.45F ? 0 : u < 0.8F ? 1 : 2];
    stroke.colour = paint + (scene.ground.colour[i] - paint) * std::clamp(scene.ground.haze[i], 0.F, 1.F);
    out.push_back(stroke);
  });
}

}  // namespace belvedere
