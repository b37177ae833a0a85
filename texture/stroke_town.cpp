#include <algorithm>
#include <array>
#include <cmath>

#include "texture/stroke_kinds.h"
#include "texture/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Roofs: brick, old brick, slate, grey; walls; encoded sRGB in full light (look/recipe.md).
constexpr std::array<glm::vec3, 4> roofs = {glm::vec3(0.74F, 0.43F, 0.31F), glm::vec3(0.62F, 0.36F, 0.28F), glm::vec3(0.42F, 0.44F, 0.49F),
                                            glm::vec3(0.55F, 0.50F, 0.47F)};
constexpr glm::vec3 wall{0.95F, 0.91F, 0.83F};
constexpr glm::vec3 snowed{0.90F, 0.92F, 0.96F};

// 0 at the edge of a settlement … 1 in the middle of a large one: villages have edges only.
float core_of(const StrokeScene& scene, glm::vec2 place) {
  const auto built = [&](std::size_t k) { return scene.class_at(k) == settlement; };
  const float near = share_around(scene, place, 6.F, built);
  return near < 0.5F ? 0.F : 0.4F * near + 0.6F * share_around(scene, place, 17.F, built);
}

// Streets of a town: blocks in bent rows on the ground, kept at some ten units of the sheet. 1 in the roadway.
bool in_street(const StrokeScene& scene, std::size_t i) {
  const float metres = std::max(scene.metres_per_unit(i), 1.F);
  const double block = std::ldexp(1.0, std::ilogb(13.0 * static_cast<double>(metres)));
  const glm::dvec3 p = glm::dvec3(scene.guidance.position_m[i]) + scene.guidance.origin_m;
  const double bend = 0.35 * block * static_cast<double>(ground_noise(scene, i, 53, 700.0));
  const double u = (p.x - 0.35 * p.y + bend) / block;
  const double v = (p.y + 0.25 * p.x - bend) / (0.8 * block);
  return u - std::floor(u) < 0.14 || v - std::floor(v) < 0.16;
}

struct House {
  glm::vec2 foot;        // middle of the lower edge, px
  float width;           // px
  float height;          // of walls and roof, px
  std::size_t roof = 0;  // of `roofs`
};

// A shadow away from the sun, walls in light, a roof over them.
void build(const StrokeScene& scene, const House& house, std::size_t i, StrokeSeed& seed, std::vector<Stroke>& out) {
  const auto side = static_cast<float>(scene.parameters.sun_side);
  const float tone = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  const float light = 0.62F + 0.42F * tone;
  Stroke body;
  body.depth_m = scene.guidance.depth_m[i];
  body.source = static_cast<std::uint32_t>(i);
  body.order = body.depth_m - 1.F;
  const float half = 0.5F * house.width;
  const float stripe = 0.55F * house.height;
  Stroke shade = body;
  shade.gate = StrokeGate::surface;
  set_line(shade, house.foot + glm::vec2(-0.6F * half * side, 0.05F * house.height),
           house.foot + glm::vec2(-1.7F * half * side, 0.1F * house.height), stripe, 0.6F * stripe);
  shade.alpha = 0.35F + 0.3F * tone;
  shade.colour = through_air(scene, i, glm::vec3(0.33F, 0.35F, 0.46F));
  out.push_back(shade);
  Stroke front = body;
  front.order -= 0.5F;
  set_line(front, house.foot + glm::vec2(-half, -0.5F * stripe), house.foot + glm::vec2(half, -0.5F * stripe), stripe, stripe);
  front.tip = StrokeTip::square;
  front.alpha = 0.92F;
  const float value = 0.03F * seed.normal();
  front.colour = through_air(scene, i, wall * light + value);
  out.push_back(front);
  Stroke roof = front;
  roof.order -= 0.5F;
  const glm::vec2 ridge{0.F, -house.height + 0.2F * stripe};
  set_line(roof, house.foot + ridge + glm::vec2(-half * 1.1F, 0.F), house.foot + ridge + glm::vec2(half * 1.1F, 0.F), 0.95F * stripe,
           0.95F * stripe);
  roof.tip = StrokeTip::square;
  const bool white = scene.parameters.winter && seed.uniform() < 0.7F;
  const float shift = 0.04F * seed.normal();
  roof.colour = through_air(scene, i, (white ? snowed : roofs[house.roof] + shift) * light);
  out.push_back(roof);
}

// A church: nave and spire, which stands out over the roofs from afar.
void build_church(const StrokeScene& scene, glm::vec2 foot, float unit, std::size_t i, StrokeSeed& seed, std::vector<Stroke>& out) {
  build(scene, {foot, 4.2F * unit, 2.6F * unit, 2}, i, seed, out);
  Stroke tower;
  tower.depth_m = scene.guidance.depth_m[i];
  tower.source = static_cast<std::uint32_t>(i);
  tower.order = tower.depth_m - 3.F;
  tower.gate = StrokeGate::upright;
  const auto side = static_cast<float>(scene.parameters.sun_side);
  const glm::vec2 base = foot + glm::vec2(-1.9F * side * unit, 0.F);
  const float light = 0.62F + 0.42F * std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  set_line(tower, base, base + glm::vec2(0.F, -3.6F * unit), 1.3F * unit, 1.2F * unit);
  tower.tip = StrokeTip::square;
  tower.alpha = 0.95F;
  tower.colour = through_air(scene, i, wall * light);
  out.push_back(tower);
  set_line(tower, base + glm::vec2(0.F, -3.8F * unit), base + glm::vec2(0.F, -7.6F * unit), 1.3F * unit, 0.1F * unit);
  tower.tip = StrokeTip::square;
  tower.order -= 0.5F;
  tower.colour = through_air(scene, i, roofs[2] * (0.8F * light));
  out.push_back(tower);
}

}  // namespace

std::vector<Stroke> houses(const StrokeScene& scene) {
  std::vector<Stroke> all = sow(scene, 3.4F, 14, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != settlement) return;
    const float core = core_of(scene, place);
    // Blocks between streets in the middle, loose houses at the edge.
    const float quarter = 0.12F * ground_noise(scene, i, 54, 160.0);
    const float share = std::clamp(0.36F + 0.62F * core + quarter, 0.15F, 0.98F);
    if (seed.uniform() > share || (core > 0.3F && in_street(scene, i))) return;
    const float u = seed.uniform();
    const bool large = core > 0.55F && seed.uniform() < 0.08F;  // a hall, a school, a works
    const float width = large ? seed.between(4.5F, 7.F) : seed.between(2.0F, 2.8F) + (0.5F + 1.1F * core) * u * u;
    const float height = large ? seed.between(2.0F, 3.0F) : seed.between(1.8F, 2.5F) + 0.5F * core;
    const float r = seed.uniform();
    const std::size_t roof = large ? 3 : r < 0.40F ? 0 : r < 0.70F ? 1 : r < 0.85F ? 2 : 3;
    build(scene, {place, width * scene.scale(), height * scene.scale(), roof}, i, seed, out);
  });
  // A church to every village, a few to a town: one place in a wide cell is its own.
  std::vector<Stroke> churches = sow(scene, 15.F, 24, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != settlement || seed.uniform() > 0.45F) return;
    const auto built = [&](std::size_t k) { return scene.class_at(k) == settlement; };
    if (share_around(scene, place, 3.F, built) < 1.F) return;
    build_church(scene, place, seed.between(0.9F, 1.15F) * scene.scale(), i, seed, out);
  });
  all.insert(all.end(), churches.begin(), churches.end());
  return all;
}

}  // namespace belvedere
