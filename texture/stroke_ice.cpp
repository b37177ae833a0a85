#include <algorithm>
#include <cmath>

#include "texture/stroke_kinds.h"
#include "texture/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr glm::vec3 moraine_paint{0.53F, 0.49F, 0.47F};  // rubble carried by ice, at tone 1/2
constexpr glm::vec3 rib_paint{0.50F, 0.47F, 0.53F};      // rock that stands out of snow
constexpr glm::vec3 depth_of_ice{0.74F, 0.88F, 1.00F};   // what is deep in ice is blue: a factor

glm::vec3 by_tone(glm::vec3 paint, float tone) { return paint * (0.62F + 0.70F * std::clamp(tone, 0.F, 1.F)); }

// Ice is torn where it falls steeply or over an edge; 0 … 1. It comes in stretches, with whole ice between.
float torn(const StrokeScene& scene, glm::vec2 place, std::size_t i) {
  const float steep = std::clamp((scene.slope_deg(i) - 7.F) / 13.F, 0.F, 1.F);
  const float moving = std::clamp((scene.slope_deg(i) - 4.F) / 5.F, 0.F, 1.F);
  const float over_edge = std::clamp(scene.relief_m(i) / 25.F, -0.3F, 0.5F);
  return moving * std::clamp(0.55F * steep + over_edge + 0.45F * sheet_noise(scene, place, 63, 20.0) - 0.42F, 0.F, 1.F);
}

// A bow across the flow, its middle `sag_px` down the flow.
void lay_bow(Stroke& stroke, glm::vec2 middle, glm::vec2 across, glm::vec2 down, float length_px, float sag_px) {
  constexpr float places[Stroke::max_points] = {-0.5F, -0.18F, 0.18F, 0.5F};
  stroke.point_count = Stroke::max_points;
  for (std::size_t k = 0; k < stroke.points.size(); ++k)
    stroke.points[k] = middle + across * (places[k] * length_px) + down * (sag_px * (1.F - 4.F * places[k] * places[k]));
}

}  // namespace

std::vector<Stroke> snow_strokes(const StrokeScene& scene) {
  return sow(scene, 5.6F, 8, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    const LandCoverClass id = scene.class_at(i);
    if (!is_ice(id)) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    stroke.tone = scene.guidance.tone[i];
    stroke.order += seed.uniform() * 150.F;
    const float u = seed.uniform();
    const float length = id == glacier ? seed.between(22.F, 48.F) : 13.F + 31.F * u * u;
    lay_line(stroke, scene, place, length, (id == glacier ? 0.10F : 0.2F) * seed.normal(), 0.2F, true, seed);
    take_brush(stroke, scene, seed.between(3.2F, 7.F), {.taper = 0.4F, .alpha = 0.55F, .bristle = 0.6F, .wetness = 0.025F});
    stroke.colour = scene.colour(i, mixed_tone(0.16F, 0.16F, seed), paint_jitter * 0.5F, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> snow_ribs(const StrokeScene& scene) {
  return sow(scene, 4.4F, 16, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != snow) return;
    const float bare = std::clamp((scene.slope_deg(i) - 27.F) / 16.F, 0.F, 1.F) * std::clamp(scene.relief_m(i) / 30.F + 0.15F, 0.F, 1.F);
    // Outcrops gather; single ones would be flies on the snow.
    const float gathered = std::clamp(0.9F * sheet_noise(scene, place, 65, 11.0) - 0.2F, 0.F, 1.F);
    if (seed.uniform() > bare * gathered) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    lay_on_top(stroke);
    const float angle = 0.25F * seed.normal();
    lay_line(stroke, scene, place, seed.between(5.F, 15.F), angle, 0.25F, true, seed);
    take_brush(stroke, scene, seed.between(1.8F, 4.F), {.taper = 0.3F, .alpha = 0.7F, .bristle = 0.45F, .wetness = 0.04F});
    const float value = 0.03F * seed.normal();
    stroke.colour = through_air(scene, i, by_tone(rib_paint, scene.guidance.tone[i]) + value);
    out.push_back(stroke);
  });
}

std::vector<Stroke> glacier_flow_lines(const StrokeScene& scene) {
  return sow(scene, 8.5F, 17, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != glacier || scene.slope_deg(i) > 27.F) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.gate = StrokeGate::same_class;
    stroke.depth_tolerance = 0.03F;
    lay_on_top(stroke);

    const bool blue = seed.uniform() < 0.5F;
    const bool band = seed.uniform() < 0.45F;
    lay_line(stroke, scene, place, seed.between(26.F, 64.F), 0.F, 0.06F, true, seed);
    take_brush(stroke, scene, band ? seed.between(3.F, 6.F) : seed.between(0.9F, 1.8F),
               {.taper = 0.35F, .alpha = band ? 0.32F : 0.42F, .bristle = 0.4F, .wetness = 0.02F});
    const float m = blue ? -seed.between(0.4F, 1.0F) : seed.between(0.5F, 1.1F);
    stroke.colour = scene.colour(i, m, paint_jitter * 0.5F, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> glacier_crevasses(const StrokeScene& scene) {
  return sow(scene, 10.F, 18, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != glacier) return;
    const float share = torn(scene, place, i);
    if (seed.uniform() > share) return;
    // A flight of bows, one below the other, the longest in the middle.
    const int count = 2 + static_cast<int>(seed.uniform() * (2.F + 5.F * share));
    const float scale = scene.scale();
    const float u = seed.uniform();
    const float longest = (3.5F + 13.F * u * u * (0.4F + share)) * scale;
    glm::vec2 middle = place;
    for (int k = 0; k < count && scene.on_canvas(middle); ++k) {
      const std::size_t here = scene.pixel(middle);
      if (scene.class_at(here) != glacier || std::abs(scene.guidance.depth_m[here] / scene.guidance.depth_m[i] - 1.F) > 0.03F) break;
      const glm::vec2 down = scene.fall_line(middle);
      const float turn = 0.14F * seed.normal();
      const float c = std::cos(turn);
      const float s = std::sin(turn);
      const glm::vec2 across{-down.y * c - down.x * s, down.x * c - down.y * s};
      const float middling = 1.F - std::abs((static_cast<float>(k) + 0.5F) / static_cast<float>(count) - 0.5F);
      const float length = longest * middling * seed.between(0.5F, 1.2F);
      Stroke gap = ground_stroke(scene, here, seed);
      gap.gate = StrokeGate::same_class;
      gap.depth_tolerance = 0.03F;
      lay_on_top(gap);
      lay_bow(gap, middle, across, down, length, -0.16F * length);
      take_brush(gap, scene, seed.between(0.7F, 1.5F), {.taper = 0.4F, .alpha = 0.8F});
      gap.colour = scene.colour(here, -1.5F, paint_jitter * 0.5F, seed) * through_air_factor(scene, here, depth_of_ice);
      Stroke lip = gap;
      for (auto& point : lip.points) point += down * (0.95F * gap.start_width);
      lip.start_width *= 0.75F;
      lip.end_width *= 0.75F;
      lip.alpha = 0.6F;
      lip.colour = scene.colour(here, 1.3F, paint_jitter * 0.5F, seed);
      out.push_back(gap);
      out.push_back(lip);
      middle += down * (seed.between(1.9F, 4.6F) * scale);
      const float aside = 0.22F * seed.normal() * longest;
      middle += across * aside;
    }
  });
}

std::vector<Stroke> glacier_edges(const StrokeScene& scene) {
  return sow(scene, 3.8F, 19, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != glacier || scene.slope_deg(i) > 30.F) return;
    // Which side the ice ends on: rubble lines it there, and the ice bends down blue.
    const glm::vec2 down = scene.fall_line(place);
    const glm::vec2 across{-down.y, down.x};
    float side = 0.F;
    for (const float reach : {2.5F, 5.F, 7.5F})
      for (const float sign : {-1.F, 1.F}) {
        const glm::vec2 there = place + across * (sign * reach * scene.scale());
        if (side != 0.F || !scene.on_canvas(there)) continue;
        const std::size_t beyond = scene.pixel(there);
        const bool same_slope = std::abs(scene.guidance.depth_m[beyond] / scene.guidance.depth_m[i] - 1.F) < 0.02F;
        if (same_slope && !is_ice(scene.class_at(beyond))) side = sign * reach;
      }
    if (side == 0.F) return;
    const bool rubble = std::abs(side) < 6.F && seed.uniform() < 0.5F;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    if (!rubble) stroke.gate = StrokeGate::same_class;
    lay_on_top(stroke);
    const glm::vec2 at = rubble ? place + across * (side * 0.8F * scene.scale()) : place;
    lay_line(stroke, scene, at, rubble ? seed.between(7.F, 18.F) : seed.between(10.F, 24.F), 0.06F * seed.normal(), 0.08F, true, seed);
    const float width = rubble ? seed.between(1.8F, 4.2F) : seed.between(1.6F, 3.4F);
    take_brush(stroke, scene, width, {.taper = 0.45F, .alpha = rubble ? 0.6F : 0.5F, .bristle = rubble ? 0.6F : 0.35F, .wetness = 0.03F});
    const float value = 0.04F * seed.normal();
    stroke.colour = rubble ? through_air(scene, i, by_tone(moraine_paint, scene.guidance.tone[i]) + value)
                           : scene.colour(i, -1.2F, paint_jitter * 0.5F, seed) * through_air_factor(scene, i, depth_of_ice);
    out.push_back(stroke);
  });
}

}  // namespace belvedere
