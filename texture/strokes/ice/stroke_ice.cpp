#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "texture/strokes/class_strokes.h"
#include "texture/strokes/ice/ice_ground.h"
#include "texture/strokes/ice/ice_plan.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float steep_deg = 24.F;

// Near snow is painted plane by plane: short flat strokes, down where it is steep, else across.
void lay_close_snow(Stroke& stroke, const StrokeScene& scene, glm::vec2 position, std::size_t i,
                    StrokeSeed& seed) {
  end_with_class(stroke);
  stay_on_plane(stroke, scene, i);
  const bool steep = scene.guidance.slope_deg[i] > steep_deg;
  const float angle = (steep ? 0.F : 1.4F) + (steep ? 0.14F : 0.35F) * seed.normal();
  lay_line(stroke, scene, position, seed.between(5.F, 13.F), angle, 0.06F, true, seed);
  take_brush(stroke, scene, seed.between(2.2F, 4.6F),
             {.taper = 0.7F, .alpha = 0.5F, .bristle = 0.1F, .wetness = 0.012F, .load = 0.4F});
  stroke.colour = scene.colour(i, 0.5F * mixed_tone(0.16F, 0.16F, seed), paint_jitter * 0.4F, seed);
}

}  // namespace

std::vector<Stroke> snow_strokes(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 5.6F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        const LandCoverClass id = scene.class_at(i);
        if (!is_ice(id)) return;
        Stroke stroke = ground_stroke(scene, i, seed);
        stroke.depth_tolerance = tight_depth;
        stroke.tone = scene.guidance.tone[i];
        stroke.order += seed.uniform() * 150.F;
        const float u = seed.uniform();
        if (is_close(scene, i, seed)) {
          lay_close_snow(stroke, scene, position, i, seed);
          out.push_back(stroke);
          return;
        }
        // Broad and calm: firn is smooth, and a glacier has long strokes along its flow.
        const float length = id == glacier ? seed.between(30.F, 64.F) : 15.F + 34.F * u * u;
        const float aside = (id == glacier ? 0.05F : 0.14F) * seed.normal();
        lay_flow(stroke, scene, position, length * scene.scale(), aside);
        take_brush(
            stroke, scene, id == glacier ? seed.between(4.F, 8.5F) : seed.between(3.6F, 8.F),
            {.taper = 0.5F, .alpha = 0.55F, .bristle = 0.22F, .wetness = 0.012F, .load = 0.4F});
        stroke.colour =
            scene.colour(i, (id == glacier ? 0.7F : 0.85F) * mixed_tone(0.16F, 0.16F, seed),
                         paint_jitter * 0.4F, seed);
        out.push_back(stroke);
      });
}

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

namespace {

constexpr glm::vec3 chasm{0.60F, 0.78F, 0.92F};  // the bottom of a crevasse: a factor
constexpr float lit_edge = 1.4F;                 // steps of tone

// A crack that is widest in its middle and ends in points: two strokes from there.
struct Crack {
  glm::vec2 centre{0.F};
  glm::vec2 half{0.F};              // from the centre to the end on the right, px
  glm::vec2 sag{0.F};               // of its ends
  std::array<glm::vec2, 2> kink{};  // of the middle of either half
  float width = 1.F;                // in the middle, px
};
void put_crack(const Stroke& like, const Crack& crack, std::vector<Stroke>& out) {
  for (const int end : {0, 1}) {
    const float side = end == 0 ? -1.F : 1.F;
    Stroke part = like;
    part.tip = StrokeTip::round;
    part.point_count = 3;
    part.points[0] = crack.centre - crack.half * (0.04F * side);
    part.points[1] = crack.centre + crack.half * (0.5F * side) + 0.25F * crack.sag +
                     crack.kink[static_cast<std::size_t>(end)];
    part.points[2] = crack.centre + crack.half * side + crack.sag;
    part.start_width = crack.width;
    part.end_width = 0.12F * crack.width;
    out.push_back(part);
  }
}

struct Ice {
  const StrokeScene& scene;
  const IceWay& field;
  std::size_t k;
  std::size_t here;
  glm::vec2 down;    // unit, of the flow
  glm::vec2 across;  // a unit of ground, units of the sheet

  glm::vec3 blue(float steps, glm::vec3 factor, StrokeSeed& seed) const {
    return scene.colour(here, steps, paint_jitter * 0.4F, seed) *
           through_air_factor(scene, here, factor);
  }
};

// A row of crevasses, some side by side.
void open_crevasses(const Ice& row, float lean, StrokeSeed& seed, std::vector<Stroke>& out) {
  const StrokeScene& scene = row.scene;
  const float scale = scene.scale();
  const auto count = static_cast<float>(row.field.positions.size());
  const float off = 2.F * std::abs((static_cast<float>(row.k) + 0.5F) / count - 0.5F);
  const float width_of_row = row.field.size_units * std::sqrt(1.F - 0.8F * off * off);
  const int beside = 1 + static_cast<int>(width_of_row / 24.F + seed.uniform());
  // As wide on the ground as the flow is foreshortened.
  const float seen_along = 0.6F + 0.4F * std::abs(row.down.x);
  for (int n = 0; n < beside; ++n) {
    // Lengths vary widely: rows of equal ones would look like fishbones.
    const float drawn = seed.uniform();
    const float share = 0.25F + 0.65F * drawn * drawn;
    const float length =
        share * width_of_row * scale * std::min(1.F, 2.F / static_cast<float>(beside) + 0.3F);
    const float room = 0.5F * std::max(0.F, width_of_row * scale - length);
    const float slot = (static_cast<float>(n) + seed.uniform()) / static_cast<float>(beside);
    const float aside = (2.F * slot - 1.F) * room;
    const float jump = seed.between(-0.8F, 0.8F) * seen_along * scale;
    const float turn = 0.07F * seed.normal();
    const float sag = seed.between(0.01F, 0.08F) * length * seen_along;
    const float left = seed.between(-0.035F, 0.035F) * length * seen_along;
    const float right = seed.between(-0.035F, 0.035F) * length * seen_along;
    // A few gape among many fine ones.
    const float u = seed.uniform();
    const float open = 0.5F + 2.1F * u * u * u + 0.018F * length / scale;
    const float alpha = 0.5F + 0.4F * u;
    const glm::vec2 way = row.across + row.down * (lean + turn);
    Crack crack;
    crack.centre = way_place(scene, row.field, row.k) + row.across * aside + row.down * jump;
    if (!scene.on_canvas(crack.centre)) continue;
    const std::size_t here = scene.pixel(crack.centre);
    if (scene.class_at(here) != row.field.land_cover) continue;
    const Ice ice{scene, row.field, row.k, here, row.down, row.across};
    crack.half = way * (0.5F * length);
    crack.sag = ice.down * sag;
    crack.kink = {ice.down * left, ice.down * right};
    const float width = std::min(open, 2.6F) * seen_along * scale;
    crack.width = width;
    Stroke gap = ice_stroke(scene, here, seed);
    gap.alpha = alpha;
    gap.colour = ice.blue(-0.9F - 0.6F * u, depth_of_ice, seed);
    Stroke deep = gap;
    deep.alpha = 0.85F;
    deep.colour = ice.blue(-1.5F, chasm, seed);
    Stroke lip = gap;
    lip.alpha = 0.7F;
    lip.colour = scene.colour(here, lit_edge, paint_jitter * 0.4F, seed);
    // The lower edge catches light; the upper wall falls into blue.
    Crack edge = crack;
    edge.centre += ice.down * (0.75F * width);
    edge.width = 0.6F * width;
    put_crack(lip, edge, out);
    put_crack(gap, crack, out);
    if (width < 0.9F * scale) continue;
    Crack bottom = crack;
    bottom.centre -= ice.down * (0.16F * width);
    bottom.half *= 0.7F;
    bottom.sag *= 0.5F;
    bottom.kink = {};
    bottom.width = 0.42F * width;
    put_crack(deep, bottom, out);
  }
}

// A cliff of ice across the flow, broken into faces of unlike breadth and height that step up and
// down: light on top, blue below, with cracks between.
void break_cliff(const Ice& ice, StrokeSeed& seed, std::vector<Stroke>& out) {
  const StrokeScene& scene = ice.scene;
  const float scale = scene.scale();
  const auto count = static_cast<float>(ice.field.positions.size());
  const float off = 2.F * std::abs((static_cast<float>(ice.k) + 0.5F) / count - 0.5F);
  const float reach = 0.5F * ice.field.size_units * std::sqrt(1.F - 0.6F * off * off);
  const float tall = seed.between(2.2F, 5.6F);
  const float aside = 0.22F * reach * seed.normal();
  const float bow = seed.between(0.5F, 3.F);  // the middle moves ahead, units
  // Broken ice is blue between its cliffs.
  Stroke veil = ice_stroke(scene, ice.here, seed);
  lay_bow(veil,
          way_place(scene, ice.field, ice.k) + ice.across * (aside * scale) +
              ice.down * (0.5F * tall * scale),
          ice.across, ice.down, 2.F * reach * scale, bow * scale);
  take_brush(veil, scene, 1.7F * tall, {.taper = 0.8F, .alpha = 0.3F, .bristle = 0.25F});
  veil.colour = ice.blue(-0.75F, depth_of_ice, seed);
  out.push_back(veil);
  float at = -reach * seed.between(0.55F, 1.F);
  const float last = reach * seed.between(0.55F, 1.F);
  float step = 0.F;  // of the row up or down here, units
  float before = 0.4F;
  while (at < last) {
    const float u = seed.uniform();
    const float broad = 2.2F + 8.5F * u * u;
    const float high = seed.between(0.45F, 1.15F);
    step = std::clamp(step + seed.between(-2.2F, 2.2F), -3.6F, 3.6F);
    const float turn = seed.between(-0.28F, 0.28F);
    const float value = seed.between(-0.35F, 0.35F);
    const bool snowed_in = seed.uniform() < 0.16F;
    const bool cracked = seed.uniform() < 0.5F;
    const float lid = seed.between(0.8F, 1.9F);
    const float middle = at + 0.5F * broad;
    at += broad;
    const float ahead = step + bow * (1.F - (middle * middle) / (reach * reach));
    const glm::vec2 place = way_place(scene, ice.field, ice.k) +
                            ice.across * ((aside + middle) * scale) + ice.down * (ahead * scale);
    const float ends = 1.F - std::min(1.F, (middle * middle) / (reach * reach));
    const float height = tall * high * std::sqrt(ends);
    const float from = std::min(before, 1.4F * height);
    before = snowed_in ? 0.3F : height;
    if (snowed_in || height < 0.45F || !scene.on_canvas(place)) continue;
    const std::size_t here = scene.pixel(place);
    if (scene.class_at(here) != ice.field.land_cover) continue;
    const Ice block{scene, ice.field, ice.k, here, ice.down, ice.across};
    const glm::vec2 side = (ice.across + ice.down * turn) * (0.5F * broad * scale);
    const glm::vec2 up{0.F, -scale};
    // The side that faces the sun is lighter.
    const float facing = 0.9F * turn * scene.sun_side(here);
    Stroke face = ice_stroke(scene, here, seed);
    set_line(face, place - side, place + side, from * scale, height * scale);
    face.tip = StrokeTip::hairs;
    face.bristle = 0.15F;
    face.alpha = 0.82F;
    face.colour = block.blue(-0.95F + value + facing, depth_of_ice, seed);
    // Deep blue at its foot, where it leaves the ice below.
    Stroke foot = face;
    set_line(foot, place - 0.9F * side - up * (0.42F * from),
             place + 0.8F * side - up * (0.42F * height), 0.35F * from * scale,
             0.5F * height * scale);
    foot.alpha = 0.7F;
    foot.colour = block.blue(-1.5F + 0.5F * value, chasm, seed);
    Stroke top = face;
    set_line(top, place - 0.96F * side + up * (0.5F * from + 0.3F * lid),
             place + side + up * (0.5F * height + 0.2F * lid), 0.8F * lid * scale, lid * scale);
    top.alpha = 0.92F;
    top.colour = scene.colour(here, lit_edge + 0.4F * value, paint_jitter * 0.4F, seed);
    out.push_back(foot);
    out.push_back(face);
    out.push_back(top);
    if (!cracked) continue;
    Stroke crack = face;
    crack.tip = StrokeTip::square;
    const glm::vec2 edge = place + side;
    set_line(crack, edge + up * (0.75F * height + 0.5F * lid), edge - up * (0.5F * height),
             0.25F * scale, 0.75F * scale);
    crack.alpha = 0.75F;
    crack.colour = block.blue(-1.5F, chasm, seed);
    out.push_back(crack);
  }
}

}  // namespace

std::vector<Stroke> glacier_crevasses(const StrokeScene& scene, Stream stream) {
  std::vector<Stroke> out;
  along_ways(scene, stream, [&](const IceWay& field) {
    if (scene.parameters.winter && field.strength < 0.35F) return;  // bridged by snow
    StrokeSeed looks = way_seed(scene, field, 0);
    const float lean = 0.12F * looks.normal();
    const float scale = scene.scale();
    const std::size_t count = field.positions.size();
    // From afar a broken field is a blue shade across the ice.
    if (const auto i = way_pixel(scene, field, count / 2)) {
      const glm::vec2 position = way_place(scene, field, count / 2);
      Stroke shade = ice_stroke(scene, *i, looks);
      lay_bow(shade, position, field.across[count / 2], ice_direction(scene, position),
              looks.between(0.7F, 1.F) * field.size_units * scale, -1.5F * scale);
      take_brush(shade, scene, looks.between(6.F, 11.F),
                 {.taper = 0.8F, .alpha = 0.18F + 0.25F * field.strength, .bristle = 0.3F});
      shade.colour = scene.colour(*i, -0.6F, paint_jitter * 0.4F, looks) *
                     through_air_factor(scene, *i, depth_of_ice);
      out.push_back(shade);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto here = way_pixel(scene, field, k);
      if (!here) continue;
      StrokeSeed seed = way_seed(scene, field, 1 + k);
      const glm::vec2 centre = way_place(scene, field, k);
      const Ice ice{scene, field, k, *here, ice_direction(scene, centre), field.across[k]};
      if (field.is_icefall)
        break_cliff(ice, seed, out);
      else
        open_crevasses(ice, lean, seed, out);
    }
  });
  return out;
}

}  // namespace belvedere
