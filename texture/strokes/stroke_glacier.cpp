#include <algorithm>
#include <cmath>
#include <optional>

#include "texture/strokes/ice_flow.h"
#include "texture/strokes/ice_ways.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr glm::vec3 moraine_paint{0.53F, 0.49F, 0.48F};  // rubble carried by ice, at tone 1/2
constexpr glm::vec3 depth_of_ice{0.80F, 0.92F, 1.00F};   // ice is blue in depth: a factor

glm::vec3 by_tone(glm::vec3 paint, float tone) {
  return paint * (0.62F + 0.70F * std::clamp(tone, 0.F, 1.F));
}

Stroke ice_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed) {
  Stroke stroke = ground_stroke(scene, i, seed);
  stroke.gate = StrokeGate::same_class;
  stroke.depth_tolerance = same_ice_depth;
  lay_on_top(stroke);
  return stroke;
}

// An arc across the flow, its centre `sag_px` down the flow.
void lay_bow(Stroke& stroke, glm::vec2 centre, glm::vec2 across, glm::vec2 down, float length_px,
             float sag_px) {
  constexpr float positions[Stroke::max_points] = {-0.5F, -0.18F, 0.18F, 0.5F};
  stroke.point_count = Stroke::max_points;
  for (std::size_t k = 0; k < stroke.points.size(); ++k)
    stroke.points[k] = centre + across * (positions[k] * length_px) +
                       down * (sag_px * (1.F - 4.F * positions[k] * positions[k]));
}

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

std::vector<Stroke> glacier_moraines(const StrokeScene& scene, Stream stream) {
  std::vector<Stroke> out;
  along_ways(scene, stream, [&](const IceWay& way) {
    StrokeSeed looks = way_seed(scene, way, 0);
    const float width = looks.between(1.4F, 2.8F);
    const float value = 0.03F * looks.normal();
    // A band of dirty ice, and the line itself on it.
    for (const bool line : {false, true})
      draw_way(scene, way, line ? 1 : 0, out,
               [&](Stroke& stroke, std::size_t here, float share, StrokeSeed&) {
                 const float fade = std::min(1.F, 0.45F + 2.5F * share) * (1.F - 0.45F * share);
                 take_brush(stroke, scene, (line ? 1.F : 3.4F) * width,
                            {.taper = 0.95F,
                             .alpha = (line ? 0.46F : 0.17F) * fade,
                             .bristle = 0.4F,
                             .wetness = 0.02F,
                             .load = 0.4F,
                             .edge = 0.15F});
                 stroke.colour = through_air(
                     scene, here, by_tone(moraine_paint, scene.guidance.tone[here]) + value);
               });
  });
  return out;
}

std::vector<Stroke> glacier_crevasses(const StrokeScene& scene, Stream stream) {
  const float scale = scene.scale();
  const auto blue = [&](std::size_t here, float m, StrokeSeed& seed) {
    return scene.colour(here, m, paint_jitter * 0.4F, seed) *
           through_air_factor(scene, here, depth_of_ice);
  };
  std::vector<Stroke> out;
  along_ways(scene, stream, [&](const IceWay& flight) {
    if (scene.parameters.winter && flight.strength < 0.35F) return;  // bridged by snow
    StrokeSeed looks = way_seed(scene, flight, 0);
    const float lean = 0.10F * looks.normal();
    // From afar a broken field is a blue shade across the ice …
    if (const auto i = way_pixel(scene, flight, 0)) {
      const glm::vec2 position = way_place(scene, flight, 0);
      const glm::vec2 fall = ice_direction(scene, position);
      Stroke field = ice_stroke(scene, *i, looks);
      lay_bow(field, position, {-fall.y, fall.x}, fall, looks.between(16.F, 32.F) * scale,
              -2.F * scale);
      take_brush(field, scene, looks.between(6.F, 11.F),
                 {.taper = 0.8F, .alpha = 0.16F + 0.22F * flight.strength, .bristle = 0.3F});
      field.colour = blue(*i, -0.7F, looks);
      out.push_back(field);
    }
    // … from near a series of arcs, one below the other, the longest in the centre.
    const std::size_t count = flight.positions.size();
    for (std::size_t k = 0; k < count; ++k) {
      const auto here = way_pixel(scene, flight, k);
      if (!here) continue;
      StrokeSeed seed = way_seed(scene, flight, 1 + k);
      const glm::vec2 centre = way_place(scene, flight, k);
      const glm::vec2 down = ice_direction(scene, centre);
      const float turn = lean + 0.05F * seed.normal();
      const glm::vec2 across = turned(glm::vec2(-down.y, down.x), turn_by(turn));
      const float middling =
          1.F - std::abs((static_cast<float>(k) + 0.5F) / static_cast<float>(count) - 0.5F);
      const float length = flight.size_units * scale * middling * seed.between(0.35F, 1.2F);
      Stroke gap = ice_stroke(scene, *here, seed);
      lay_bow(gap, centre, across, down, length, -0.13F * length);
      for (auto& point : gap.points)
        point += down * (0.035F * length * seed.normal());  // cracks are not exact arcs
      const float width = seed.between(0.6F, 1.1F) + 0.035F * length / scale;
      take_brush(gap, scene, width, {.taper = 0.35F, .alpha = seed.between(0.5F, 0.85F)});
      gap.colour = blue(*here, -1.4F, seed);
      Stroke lip = gap;
      for (auto& point : lip.points) point += down * (0.95F * gap.start_width);
      lip.start_width *= 0.8F;
      lip.end_width *= 0.8F;
      lip.alpha = 0.55F;
      lip.colour = scene.colour(*here, 1.3F, paint_jitter * 0.4F, seed);
      out.push_back(gap);
      out.push_back(lip);
      // Where it is most broken, towers of ice stand between the cracks: a white head over a blue
      // wall.
      if (flight.strength > 0.45F && seed.uniform() < 0.7F) {
        const float aside = seed.between(-0.4F, 0.4F) * length;
        const glm::vec2 at = centre + across * aside + down * (seed.between(1.6F, 3.F) * scale);
        const float size = seed.between(1.6F, 3.2F) * scale;
        Stroke wall = ice_stroke(scene, *here, seed);
        set_line(wall, at - across * (0.5F * size), at + across * (0.5F * size), 0.9F * size,
                 0.7F * size);
        wall.alpha = 0.7F;
        wall.colour = blue(*here, -1.1F, seed);
        Stroke head = wall;
        for (auto& point : head.points) point -= glm::vec2(0.F, 0.45F * size);
        head.start_width *= 0.7F;
        head.end_width *= 0.7F;
        head.alpha = 0.9F;
        head.colour = scene.colour(*here, 1.5F, paint_jitter * 0.4F, seed);
        out.push_back(wall);
        out.push_back(head);
      }
    }
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
                 const float chance = seed.uniform();
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
               const bool rubble = std::abs(side) < 6.F && seed.uniform() < 0.5F;
               Stroke stroke = ice_stroke(scene, i, seed);
               if (rubble) stroke.gate = StrokeGate::surface;
               stroke.depth_tolerance = tight_depth;
               const glm::vec2 at = rubble ? position + across * (side * 0.8F * scale) : position;
               const float length = rubble ? seed.between(7.F, 18.F) : seed.between(12.F, 28.F);
               lay_flow(stroke, scene, at, length * scale, 0.05F * seed.normal());
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
