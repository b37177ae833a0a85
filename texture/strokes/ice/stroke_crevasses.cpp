#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "texture/strokes/ice/ice_ways.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
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
    // Of very unlike length: rows of equal ones would be the bones of a fish.
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
