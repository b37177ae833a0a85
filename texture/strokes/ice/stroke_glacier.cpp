#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "texture/strokes/ice/ice_flow.h"
#include "texture/strokes/ice/ice_ways.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// A line along a path, as joined strokes of four positions; `load` sets brush and colour of each.
// Several lines on one path are distinguished by `line`, 0…2.
template <class Load>
void draw_way(const StrokeScene& scene, const IceWay& way, std::size_t line,
              std::vector<Stroke>& out, Load&& load) {
  for (std::size_t k = 0; k + 3 < way.positions.size(); k += 3) {
    std::optional<std::size_t> here = way_pixel(scene, way, k + 1);
    if (!here) here = way_pixel(scene, way, k + 2);  // a stone in the ice does not end a line
    if (!here) continue;
    StrokeSeed seed = way_seed(scene, way, 1 + k + line);
    Stroke stroke = ice_stroke(scene, *here, seed);
    stroke.point_count = 4;
    for (std::size_t j = 0; j < 4; ++j) stroke.points[j] = way_place(scene, way, k + j);
    load(stroke, *here, static_cast<float>(k) / static_cast<float>(way.positions.size()), seed);
    out.push_back(stroke);
  }
}

// Distance, within `reach_units` in a direction, to where the glacier ends on ground (not on snow);
// 0: it does not.
float end_within(const StrokeScene& scene, glm::vec2 position, std::size_t i, glm::vec2 heading,
                 float reach_units) {
  for (float reach = 2.5F; reach <= reach_units; reach += 2.5F) {
    const glm::vec2 there = position + heading * (reach * scene.scale());
    if (!scene.on_canvas(there)) return 0.F;
    const std::size_t beyond = scene.pixel(there);
    if (!same_ice_surface(scene, beyond, i)) return 0.F;
    if (!is_ice(scene.class_at(beyond))) return reach;
  }
  return 0.F;
}

}  // namespace

std::vector<Stroke> glacier_flow_lines(const StrokeScene& scene, Stream stream) {
  std::vector<Stroke> out;
  if (scene.parameters.winter) return out;  // under snow
  along_ways(scene, stream, [&](const IceWay& way) {
    StrokeSeed looks = way_seed(scene, way, 0);
    const bool blue = looks.uniform() < 0.6F;
    const bool band = looks.uniform() < 0.4F;
    const float width = band ? looks.between(3.F, 6.5F) : looks.between(0.9F, 1.7F);
    const float m = blue ? -looks.between(0.4F, 0.95F) : looks.between(0.5F, 1.1F);
    draw_way(scene, way, 0, out,
             [&](Stroke& stroke, std::size_t here, float share, StrokeSeed& seed) {
               const float fade = 1.F - 0.6F * share;
               take_brush(stroke, scene, width,
                          {.taper = 0.85F,
                           .alpha = (band ? 0.30F : 0.40F) * fade,
                           .bristle = 0.3F,
                           .wetness = 0.01F});
               stroke.colour = scene.colour(here, m, paint_jitter * 0.4F, seed);
             });
  });
  return out;
}

std::vector<Stroke> glacier_edges(const StrokeScene& scene, Stream stream) {
  return sow(scene, 4.6F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.parameters.winter) return;  // covered by snow
               if (scene.class_at(i) != glacier || scene.slope_deg(i) > 34.F) return;
               const float scale = scene.scale();
               const glm::vec2 down = ice_direction(scene, position);
               const glm::vec2 across{-down.y, down.x};
               const auto dirt = [&](std::size_t here, float value) {
                 return through_air(scene, here,
                                    by_tone(moraine_paint, scene.guidance.tone[here]) + value);
               };
               // The tongue: its last stretch is dirty, and it ends in a blue wall over rubble.
               if (const float ahead = end_within(scene, position, i, down, 20.F); ahead > 0.F) {
                 // Near, rubble lies as ground of its own around the ice.
                 const float chance = is_close(scene, i, seed) ? 1.F : seed.uniform();
                 const float value = 0.04F * seed.normal();
                 Stroke stroke = ice_stroke(scene, i, seed);
                 if (ahead < 5.1F) {
                   lay_bow(stroke, position + down * (0.5F * ahead * scale), across, down,
                           seed.between(6.F, 12.F) * scale, 0.8F * scale);
                   take_brush(stroke, scene, seed.between(1.8F, 3.4F),
                              {.taper = 0.6F, .alpha = 0.62F, .bristle = 0.3F});
                   stroke.colour = scene.colour(i, -1.4F, paint_jitter * 0.5F, seed) *
                                   through_air_factor(scene, i, depth_of_ice);
                   out.push_back(stroke);
                   if (chance < 0.6F) {
                     Stroke rubble = ground_stroke(scene, i, seed);
                     rubble.depth_tolerance = same_ice_depth;
                     lay_on_top(rubble);
                     lay_bow(rubble, position + down * ((ahead + 2.F) * scale), across, down,
                             seed.between(5.F, 13.F) * scale, 1.2F * scale);
                     take_brush(rubble, scene, seed.between(1.8F, 4.2F),
                                {.taper = 0.5F, .alpha = 0.6F, .bristle = 0.6F, .wetness = 0.03F});
                     rubble.colour = dirt(i, value);
                     out.push_back(rubble);
                   }
                 } else if (chance < 0.8F * (1.F - ahead / 24.F)) {
                   const float aside = 0.12F * seed.normal();
                   const float length = seed.between(9.F, 18.F);
                   lay_flow(stroke, scene, position, length * scale, aside);
                   take_brush(stroke, scene, seed.between(3.F, 7.F),
                              {.taper = 0.6F,
                               .alpha = 0.17F,
                               .bristle = 0.6F,
                               .wetness = 0.02F,
                               .load = 0.4F,
                               .edge = 0.1F});
                   stroke.colour = dirt(i, value);
                   out.push_back(stroke);
                 }
                 return;
               }
               // Its sides: they are lined with rubble, and the ice curves down, blue.
               float side = 0.F;
               for (const float sign : {-1.F, 1.F}) {
                 const float reach = end_within(scene, position, i, sign * across, 7.5F);
                 if (reach > 0.F && (side == 0.F || reach < std::abs(side))) side = sign * reach;
               }
               if (side == 0.F) return;
               // Where the ice ends ahead, behind a step, it has no side.
               for (const float ahead : {5.F, 10.F, 15.F, 20.F}) {
                 const glm::vec2 there = position + down * (ahead * scale);
                 if (!scene.on_canvas(there) || !is_ice(scene.class_at(scene.pixel(there)))) return;
               }
               // Along the border, which must go on above and below.
               constexpr float along_units = 4.F;
               const auto border = [&](float along) -> std::optional<glm::vec2> {
                 const glm::vec2 there = position + down * (along * scale);
                 if (!scene.on_canvas(there) || !is_ice(scene.class_at(scene.pixel(there))))
                   return std::nullopt;
                 const float reach = end_within(scene, there, i, (side > 0.F ? 1.F : -1.F) * across,
                                                std::abs(side) + along_units);
                 if (reach <= 0.F) return std::nullopt;
                 return there + across * ((side > 0.F ? reach : -reach) * scale);
               };
               const auto above = border(-along_units);
               const auto below = border(along_units);
               if (!above || !below) return;
               const bool rubble = std::abs(side) < 6.F && seed.uniform() < 0.5F;
               if (rubble && is_close(scene, i, seed)) return;
               Stroke stroke = ice_stroke(scene, i, seed);
               if (rubble) stroke.gate = StrokeGate::surface;
               stroke.depth_tolerance = tight_depth;
               const glm::vec2 at = rubble ? position + across * (side * 0.8F * scale) : position;
               const float length = rubble ? seed.between(5.F, 13.F) : seed.between(9.F, 20.F);
               const glm::vec2 way = *below - *above;
               const float turn = 0.05F * seed.normal();
               lay_bow(stroke, at, turned(way / glm::length(way), turn_by(turn)), down,
                       length * scale, 0.F);
               const float width = rubble ? seed.between(1.6F, 3.6F) : seed.between(1.6F, 3.4F);
               take_brush(stroke, scene, width,
                          {.taper = 0.45F,
                           .alpha = rubble ? 0.55F : 0.30F,
                           .bristle = rubble ? 0.6F : 0.3F,
                           .wetness = 0.02F});
               const float value = 0.04F * seed.normal();
               stroke.colour = rubble ? dirt(i, value)
                                      : scene.colour(i, -1.1F, paint_jitter * 0.5F, seed) *
                                            through_air_factor(scene, i, depth_of_ice);
               out.push_back(stroke);
             });
}

}  // namespace belvedere
