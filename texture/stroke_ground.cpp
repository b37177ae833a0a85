#include <algorithm>
#include <cmath>
#include <limits>

#include "texture/stroke_kinds.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float jitter = 0.018F;  // deviation of a stroke's colour, encoded sRGB
constexpr float quarter_turn = 1.57F;
constexpr float tight_depth = 0.014F;  // rock, snow and scree must not smear across the smallest ridge

// How the brush of one kind of stroke is loaded and drawn out.
struct Brush {
  float taper = 1.F;  // width at the end / at the start
  float alpha = 1.F;
  float bristle = 0.F;
  float wetness = 0.F;
};

void take_brush(Stroke& stroke, const StrokeScene& scene, float width_units, const Brush& brush) {
  stroke.start_width = width_units * scene.scale();
  stroke.end_width = stroke.start_width * brush.taper;
  stroke.alpha = brush.alpha;
  stroke.bristle = brush.bristle;
  stroke.wetness = brush.wetness;
}

// A stroke of the ground with what all of them share.
Stroke ground_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed) {
  Stroke stroke;
  stroke.depth_m = scene.guidance.depth_m[i];
  stroke.order = stroke.depth_m;
  stroke.seed = seed.bits();
  stroke.source = static_cast<std::uint32_t>(i);
  return stroke;
}

bool is_floor(LandCoverClass id) { return id == valley_floor || id == settlement; }
bool is_grass(LandCoverClass id) { return id == valley_floor || id == pasture || id == alpine_grass || id == shrub; }

}  // namespace

std::vector<Stroke> sky_strokes(const StrokeScene& scene) {
  return sow(scene, 5.F, 1, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (!scene.guidance.is_sky(i)) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.gate = StrokeGate::sky;
    const float angle = seed.normal() * 0.05F;
    lay_line(stroke, scene, place, seed.between(26.F, 66.F), angle, 0.12F, false, seed);
    take_brush(stroke, scene, seed.between(5.F, 11.F), {.taper = 0.7F, .alpha = 0.30F, .bristle = 0.5F, .wetness = 0.015F});
    stroke.colour = scene.colour(i, 0.2F * seed.normal(), 0.006F, seed);
    stroke.order = seed.uniform();
    out.push_back(stroke);
  });
}

std::vector<Stroke> wash_strokes(const StrokeScene& scene) {
  return sow(scene, 5.F, 2, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if (id == sky || id == water) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    const float length = id == snow || id == glacier ? 20.F : id == rock ? 16.F : id == forest ? 10.F : 14.F;
    stroke.depth_tolerance = id == rock || id == snow || id == glacier ? tight_depth : 0.03F;
    if (id != forest) stroke.tone = scene.guidance.tone[i];
    const float turn = is_grass(id) && !is_floor(id) && seed.uniform() < 0.35F ? quarter_turn : 0.F;
    const float angle = turn + seed.normal() * (is_floor(id) ? 0.15F : is_grass(id) ? 0.3F : 0.2F);
    lay_line(stroke, scene, place, length * seed.between(0.7F, 1.3F), angle, 0.2F, !is_floor(id), seed);
    take_brush(stroke, scene, (id == forest ? 4.F : 6.F) * seed.between(0.7F, 1.3F),
               {.taper = 0.6F, .alpha = 0.55F, .bristle = 0.5F, .wetness = 0.03F});
    stroke.colour = scene.colour(i, id == forest ? -0.55F + 0.35F * seed.normal() : mixed_tone(0.22F, 0.15F, seed), jitter, seed);
    stroke.order += seed.uniform() * 300.F;
    out.push_back(stroke);
  });
}

std::vector<Stroke> meadow_strokes(const StrokeScene& scene) {
  return sow(scene, 4.2F, 3, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if (!is_grass(id)) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    const float length = (id == valley_floor ? 9.F : id == alpine_grass ? 8.8F : 8.F) * seed.between(0.6F, 1.4F);
    if (id == valley_floor) {
      lay_line(stroke, scene, place, length, seed.normal() * 0.12F, 0.1F, false, seed);
    } else {
      const float turn = seed.uniform() < 0.5F ? 0.F : quarter_turn;
      lay_line(stroke, scene, place, length, turn + 0.25F * seed.normal(), 0.2F, true, seed);
    }
    take_brush(stroke, scene, (id == valley_floor ? 2.2F : 2.6F) * seed.between(0.7F, 1.3F),
               {.taper = 0.5F, .alpha = 0.6F, .bristle = 0.4F, .wetness = 0.03F});
    stroke.colour = scene.colour(i, mixed_tone(0.25F, 0.20F, seed), jitter * 1.3F, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> rock_facets(const StrokeScene& scene) {
  return sow(scene, 4.6F, 4, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != rock) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    const float tone = scene.guidance.tone[i];
    stroke.depth_tolerance = tight_depth;
    stroke.tone = tone;
    stroke.order += 400.F + seed.uniform() * 100.F;
    const float oblique = seed.uniform() < 0.25F ? (seed.uniform() < 0.5F ? 0.8F : -0.8F) : 0.F;
    const float angle = 0.30F * seed.normal() + oblique;
    lay_line(stroke, scene, place, seed.between(6.F, 15.F), angle, 0.1F, true, seed);
    const float width = seed.between(3.2F, 6.4F);
    take_brush(stroke, scene, width, {.taper = seed.between(0.55F, 1.05F), .alpha = 0.9F, .bristle = 0.08F, .wetness = 0.02F});
    const float m = tone > 0.60F   ? seed.between(0.1F, 0.6F)
                    : tone < 0.42F ? -seed.between(0.1F, 0.6F)
                                   : (seed.uniform() < 0.5F ? 0.55F : -0.55F);
    stroke.colour = scene.colour(i, m, jitter * 1.1F, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> rock_hatching(const StrokeScene& scene) {
  return sow(scene, 3.4F, 5, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != rock) return;
    const float edge = scene.ground.accent[i];
    const bool ledge = seed.uniform() < 0.12F;
    if (seed.uniform() > 0.5F + 0.5F * std::min(1.F, std::abs(edge))) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    stroke.order += seed.uniform() * 100.F;
    const float u = seed.uniform();
    const float length = ledge ? 4.F + 6.F * u : 5.F + 12.F * u * u;
    lay_line(stroke, scene, place, length, (ledge ? quarter_turn : 0.F) + 0.22F * seed.normal(), 0.12F, true, seed);
    const bool dark = seed.uniform() < (edge < 0.F ? 0.8F : 0.35F);
    take_brush(stroke, scene, dark ? seed.between(1.1F, 2.3F) : seed.between(1.2F, 2.5F), {.taper = 0.3F, .alpha = 0.75F, .bristle = 0.1F});
    stroke.colour = scene.colour(i, dark ? -seed.between(0.9F, 1.5F) : seed.between(0.7F, 1.3F), jitter, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> rock_fissures(const StrokeScene& scene) {
  return sow(scene, 7.5F, 6, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != rock || scene.guidance.tone[i] < 0.45F || seed.uniform() > 0.6F) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = 0.012F;
    stroke.order -= 5.F;
    const float angle = 0.35F * seed.normal();
    lay_line(stroke, scene, place, seed.between(7.F, 21.F), angle, 0.25F, true, seed);
    take_brush(stroke, scene, seed.between(1.0F, 1.7F), {.alpha = 0.62F});
    stroke.end_width = 0.5F * scene.scale();  // all run out equally fine
    stroke.colour = scene.colour(i, -seed.between(1.25F, 1.5F), jitter, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> scree_strokes(const StrokeScene& scene) {
  return sow(scene, 3.2F, 7, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != scree) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    stroke.tone = scene.guidance.tone[i];
    const float u = seed.uniform();
    lay_line(stroke, scene, place, 1.5F + 4.F * u * u, 0.15F * seed.normal(), 0.1F, true, seed);
    take_brush(stroke, scene, seed.between(1.1F, 2.2F), {.taper = 0.7F, .alpha = 0.6F});
    stroke.colour = scene.colour(i, mixed_tone(0.35F, 0.35F, seed), jitter * 1.4F, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> snow_strokes(const StrokeScene& scene) {
  return sow(scene, 5.F, 8, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if (id != snow && id != glacier) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    stroke.tone = scene.guidance.tone[i];
    stroke.order += seed.uniform() * 150.F;
    const bool across = id == glacier && seed.uniform() < 0.3F;  // crevasses
    const float angle = 0.25F * seed.normal() + (across ? quarter_turn : 0.F);
    lay_line(stroke, scene, place, seed.between(9.F, 21.F), angle, 0.25F, true, seed);
    take_brush(stroke, scene, seed.between(3.F, 6.F), {.taper = 0.45F, .alpha = 0.55F, .bristle = 0.55F, .wetness = 0.02F});
    stroke.colour = scene.colour(i, mixed_tone(0.12F, 0.20F, seed), jitter * 0.5F, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> water_strokes(const StrokeScene& scene) {
  return sow(scene, 3.2F, 9, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != water) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.gate = StrokeGate::water;
    const float angle = seed.normal() * 0.015F;
    lay_line(stroke, scene, place, seed.between(10.F, 26.F), angle, 0.02F, false, seed);
    take_brush(stroke, scene, seed.between(1.4F, 3.2F), {.taper = 0.5F, .alpha = 0.5F, .bristle = 0.4F, .wetness = 0.02F});
    stroke.colour = scene.colour(i, mixed_tone(0.15F, 0.22F, seed), jitter * 0.6F, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> accent_strokes(const StrokeScene& scene) {
  return sow(scene, 2.6F, 10, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const float edge = scene.ground.accent[i];
    const LandCoverClass id = scene.class_at(i);
    if (std::abs(edge) < 0.25F || seed.uniform() > std::abs(edge)) return;
    if (id == sky || id == water || id == settlement || id == forest) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = 0.01F;
    stroke.order = seed.uniform();
    const float angle = (edge > 0.F ? 0.3F : 0.2F) * seed.normal();
    lay_line(stroke, scene, place, seed.between(4.F, 11.F), angle, 0.1F, true, seed);
    take_brush(stroke, scene, seed.between(1.1F, 2.2F), {.taper = 0.3F, .alpha = 0.55F * std::min(1.F, std::abs(edge)), .bristle = 0.2F});
    stroke.colour = scene.colour(i, edge > 0.F ? 1.1F : -1.1F, jitter * 0.6F, seed);
    out.push_back(stroke);
  });
}

}  // namespace belvedere
