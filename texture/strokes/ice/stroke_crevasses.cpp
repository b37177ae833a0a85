#include <algorithm>
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
  glm::vec2 half{0.F};  // from the centre to the end on the right, px
  glm::vec2 sag{0.F};   // of its ends
  float width = 1.F;    // in the middle, px
};
void put_crack(const Stroke& like, const Crack& crack, std::vector<Stroke>& out) {
  for (const float side : {-1.F, 1.F}) {
    Stroke part = like;
    part.tip = StrokeTip::round;
    part.point_count = 3;
    part.points[0] = crack.centre - crack.half * (0.04F * side);
    part.points[1] = crack.centre + crack.half * (0.5F * side) + 0.25F * crack.sag;
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
    const float share = seed.between(0.45F, 0.85F);
    const float length =
        share * width_of_row * scale * std::min(1.F, 2.F / static_cast<float>(beside) + 0.3F);
    const float room = 0.5F * std::max(0.F, width_of_row * scale - length);
    const float slot = (static_cast<float>(n) + seed.uniform()) / static_cast<float>(beside);
    const float aside = (2.F * slot - 1.F) * room;
    const float jump = seed.between(-0.8F, 0.8F) * seen_along * scale;
    const float turn = 0.04F * seed.normal();
    const float sag = seed.between(0.04F, 0.10F) * length * seen_along;
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
    bottom.width = 0.42F * width;
    put_crack(deep, bottom, out);
  }
}

// A row of blocks that lean down the fall: a blue face below a light top.
void break_blocks(const Ice& ice, StrokeSeed& seed, std::vector<Stroke>& out) {
  const float scale = ice.scene.scale();
  const float reach = 0.5F * std::min(ice.field.size_units, 40.F);
  float at = -reach * seed.between(0.6F, 1.F);
  while (at < reach) {
    const float size = seed.between(1.5F, 3.6F);
    const float turn = 0.4F * seed.normal();
    const float jump = seed.between(-1.4F, 1.4F);
    const float chance = seed.uniform();
    const float tall = seed.between(0.7F, 1.2F);
    const float value = seed.between(-0.4F, 0.4F);
    const glm::vec2 place = way_place(ice.scene, ice.field, ice.k) + ice.across * (at * scale) +
                            ice.down * (jump * scale);
    at += size * seed.between(0.85F, 1.5F);
    if (chance > 0.8F || !ice.scene.on_canvas(place)) continue;
    const std::size_t here = ice.scene.pixel(place);
    if (ice.scene.class_at(here) != ice.field.land_cover) continue;
    const glm::vec2 side = ice.across + ice.down * turn;
    const float height = tall * (0.8F + 0.5F * size) * scale;
    const Ice block{ice.scene, ice.field, ice.k, here, ice.down, ice.across};
    Stroke face = ice_stroke(ice.scene, here, seed);
    set_line(face, place - side * (0.5F * size * scale), place + side * (0.42F * size * scale),
             height, 0.75F * height);
    face.tip = StrokeTip::square;
    face.alpha = 0.85F;
    face.colour = block.blue(-1.3F + 0.4F * value, depth_of_ice, seed);
    Stroke top = face;
    top.tip = StrokeTip::hairs;
    const glm::vec2 up = glm::vec2(0.F, -0.55F * height);
    for (auto& point : top.points) point += up;
    top.start_width = 0.55F * height;
    top.end_width = 0.35F * height;
    top.alpha = 0.95F;
    top.colour = ice.scene.colour(here, lit_edge + 0.2F * value, paint_jitter * 0.4F, seed);
    Stroke foot = face;
    foot.tip = StrokeTip::hairs;
    for (auto& point : foot.points) point -= 0.8F * up;
    foot.start_width = 0.3F * height;
    foot.end_width = 0.15F * height;
    foot.alpha = 0.8F;
    foot.colour = block.blue(-1.5F, chasm, seed);
    out.push_back(foot);
    out.push_back(face);
    out.push_back(top);
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
      if (field.is_icefall && k % 2 == 1)
        break_blocks(ice, seed, out);
      else
        open_crevasses(ice, lean, seed, out);
    }
  });
  return out;
}

}  // namespace belvedere
