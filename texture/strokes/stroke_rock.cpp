#include <algorithm>
#include <array>
#include <optional>

#include "texture/strokes/class_strokes.h"
#include "texture/strokes/stroke_parts.h"
#include "texture/strokes/stroke_trees.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float tone_of_m = 0.17F;        // change of tone in scene.colour for m = 1
constexpr float wall_m_per_unit = 22.0F;  // ground in a unit at which strokes have the sizes below
constexpr float broken_hue =
    0.020F;  // deviation, encoded sRGB: strokes warmer and cooler than their plane

// One pass of the brush over a wall. Lengths in units.
struct RockPass {
  float spacing;
  float shortest, longest;
  float narrowest, widest;
  float alpha;
  float tone;        // deviation of the stroke's tone from its plane's
  float across;      // share of strokes across their plane …
  float across_rad;  // … by this angle
  float min;         // share of strokes painted in calm areas, relative to busy ones
};

// Density of detail, 0 calm … 1 busy.
float busy_at(const StrokeScene& scene, glm::vec2 position) {
  return std::clamp(0.6F + 0.35F * sheet_noise(scene, position, Stream::rock_calm, 13.0), 0.F, 1.F);
}

// Size of strokes by the planes they lie on: broad on near walls, small on far ones.
float facet_size_at(const StrokeScene& scene, std::size_t i) {
  return std::clamp(wall_m_per_unit / std::max(scene.metres_per_unit(i), 0.01F), 0.55F, 1.25F);
}

// A stroke belongs to its plane: it has the plane's direction and tone, and ends where it ends.
std::vector<Stroke> paint_planes(const StrokeScene& scene, Stream stream, const RockPass& pass,
                                 float order) {
  return sow(
      scene, pass.spacing, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        if (scene.class_at(i) != rock) return;
        const float busy = busy_at(scene, position);
        if (seed.uniform() > pass.min + (1.F - pass.min) * busy) return;
        const float tone = scene.guidance.tone[i];
        const float shade = std::clamp((0.55F - tone) / 0.30F, 0.F, 1.F);
        Stroke stroke = ground_stroke(scene, i, seed);
        stroke.depth_tolerance = tight_depth;
        stroke.tone = tone;
        stroke.tone_width = 0.06F;
        if (!scene.guidance.rock_facet.empty()) stroke.facet = scene.guidance.rock_facet[i];
        const float later = seed.uniform();
        stroke.order += order + 60.F * later;
        const float size = facet_size_at(scene, i);
        const float drawn = seed.uniform();
        const float stray = 0.14F * seed.normal();
        const float side = seed.uniform() < 0.5F ? -1.F : 1.F;
        const float angle = stray + (drawn < pass.across ? side * pass.across_rad : 0.F);
        const float length = seed.between(pass.shortest, pass.longest) * size;
        lay_line(stroke, scene, position, length, angle, 0.05F, true, seed);
        const float width = seed.between(pass.narrowest, pass.widest) * size;
        const float taper = seed.between(0.55F, 1.0F);
        take_brush(stroke, scene, width,
                   {.taper = taper, .alpha = pass.alpha, .bristle = 0.10F, .wetness = 0.02F});
        const float calmer =
            (1.F - 0.4F * shade) * (0.55F + 0.45F * busy) * (1.F - 0.5F * scene.base.haze[i]);
        const float m = std::clamp(pass.tone / tone_of_m * calmer * seed.normal(), -1.5F, 1.5F);
        stroke.colour = scene.colour(i, m, 0.F, seed);
        const float warm = broken_hue * (1.F - 0.4F * shade) * seed.normal();
        stroke.colour += glm::vec3(warm, 0.15F * warm, -warm);
        out.push_back(stroke);
      });
}

}  // namespace

std::vector<Stroke> rock_facets(const StrokeScene& scene, Stream stream) {
  constexpr RockPass pass{.spacing = 3.0F,
                          .shortest = 6.4F,
                          .longest = 12.8F,
                          .narrowest = 2.6F,
                          .widest = 4.5F,
                          .alpha = 0.85F,
                          .tone = 0.05F,
                          .across = 0.F,
                          .across_rad = 0.F,
                          .min = 0.55F};
  return paint_planes(scene, stream, pass, 460.F);
}

std::vector<Stroke> rock_dabs(const StrokeScene& scene, Stream stream) {
  constexpr RockPass pass{.spacing = 2.0F,
                          .shortest = 3.2F,
                          .longest = 6.7F,
                          .narrowest = 1.3F,
                          .widest = 2.4F,
                          .alpha = 0.75F,
                          .tone = 0.085F,
                          .across = 0.30F,
                          .across_rad = 1.35F,
                          .min = 0.55F};
  return paint_planes(scene, stream, pass, 300.F);
}

std::vector<Stroke> rock_chips(const StrokeScene& scene, Stream stream) {
  constexpr RockPass pass{.spacing = 1.3F,
                          .shortest = 1.7F,
                          .longest = 4.0F,
                          .narrowest = 0.6F,
                          .widest = 1.3F,
                          .alpha = 0.80F,
                          .tone = 0.12F,
                          .across = 0.45F,
                          .across_rad = quarter_turn - 0.12F,
                          .min = 0.20F};
  return paint_planes(scene, stream, pass, 100.F);
}

namespace {

using enum LandCoverClass;

bool grows(LandCoverClass id) { return has_trait(id, ClassTrait::turf); }

// The pixel `reach_units` down (or, negative, up) the fall line from a position, if it is on the
// same slope.
std::optional<std::size_t> along_slope(const StrokeScene& scene, glm::vec2 position, std::size_t i,
                                       float reach_units) {
  const glm::vec2 there = position + scene.fall_line(position) * (reach_units * scene.scale());
  if (!scene.on_canvas(there)) return std::nullopt;
  const std::size_t k = scene.pixel(there);
  if (!on_same_slope(scene, i, k)) return std::nullopt;
  return k;
}

// The first pixel of forest on the same slope in one of eight directions.
std::optional<std::size_t> forest_around(const StrokeScene& scene, glm::vec2 position,
                                         std::size_t i, float radius_units) {
  constexpr float s = 0.7071F;
  constexpr std::array<glm::vec2, 8> directions = {
      {{0.F, 1.F}, {-s, s}, {s, s}, {-1.F, 0.F}, {1.F, 0.F}, {-s, -s}, {s, -s}, {0.F, -1.F}}};
  for (const glm::vec2 direction : directions) {
    const glm::vec2 there = position + direction * (radius_units * scene.scale());
    if (!scene.on_canvas(there)) continue;
    const std::size_t k = scene.pixel(there);
    if (scene.class_at(k) == forest && on_same_slope(scene, i, k)) return k;
  }
  return std::nullopt;
}

constexpr float near_units = 5.F;
constexpr float far_units = 11.F;

}  // namespace

std::vector<Stroke> rock_turf(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.0F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.class_at(i) != rock) return;
               // Tongues of turf from above, so that an edge is nowhere a line.
               const float reach = seed.uniform() < 0.6F ? 3.F : 7.F;
               const float tufts = std::clamp(
                   0.5F + 0.6F * sheet_noise(scene, position, Stream::turf_places, 7.0), 0.F, 1.F);
               if (const auto above = along_slope(scene, position, i, -reach);
                   above && grows(scene.class_at(*above))) {
                 if (seed.uniform() > (reach < 4.F ? 0.75F : 0.45F) * tufts) return;
                 Stroke stroke = ground_stroke(scene, i, seed);
                 stroke.source = static_cast<std::uint32_t>(*above);
                 stroke.depth_tolerance = tight_depth;
                 stroke.order -= 12.F;
                 const glm::vec2 start =
                     position - scene.fall_line(position) * (0.45F * reach * scene.scale());
                 if (!scene.on_canvas(start)) return;
                 const float aside = 0.3F * seed.normal();
                 const float length = reach + seed.between(1.F, 6.F);
                 lay_line(stroke, scene, start, length, aside, 0.3F, true, seed);
                 take_brush(stroke, scene, seed.between(1.2F, 2.4F),
                            {.taper = 0.3F, .alpha = 0.8F, .bristle = 0.25F});
                 const float m = scene.class_at(*above) == forest ? -0.6F + 0.4F * seed.normal()
                                                                  : mixed_tone(0.3F, 0.15F, seed);
                 stroke.colour = scene.colour(*above, m, paint_jitter, seed);
                 out.push_back(stroke);
                 return;
               }
               // Grass on ledges, as far as there is vegetation around.
               const float radius = seed.between(6.F, 16.F);
               if (seed.uniform() > 0.30F * tufts) return;
               for (const float way : {1.F, -1.F}) {
                 const auto there = along_slope(scene, position, i, way * radius);
                 if (!there || !grows(scene.class_at(*there))) continue;
                 Stroke stroke = ground_stroke(scene, i, seed);
                 stroke.source = static_cast<std::uint32_t>(*there);
                 stroke.depth_tolerance = tight_depth;
                 stroke.order -= 12.F;
                 const float across = quarter_turn + 0.3F * seed.normal();
                 const float length = seed.between(3.F, 8.F);
                 lay_line(stroke, scene, position, length, across, 0.3F, true, seed);
                 take_brush(stroke, scene, seed.between(0.9F, 2.0F),
                            {.taper = 0.4F, .alpha = 0.7F, .bristle = 0.3F});
                 stroke.colour =
                     scene.colour(*there, -0.2F + 0.4F * seed.normal(), paint_jitter, seed);
                 out.push_back(stroke);
                 return;
               }
             });
}

std::vector<Stroke> rock_drifts(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.2F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.class_at(i) != rock) return;
               const float up = seed.uniform() < 0.65F ? 1.F : -1.F;
               const float reach = seed.between(2.5F, 7.F);
               const auto snow_pixel = along_slope(scene, position, i, up * reach);
               if (!snow_pixel || !is_ice(scene.class_at(*snow_pixel))) return;
               // Up the gullies in tongues; bare ribs rise from it.
               const float gathered = std::clamp(
                   0.55F + 0.8F * sheet_noise(scene, position, Stream::drift_places, 6.0) -
                       scene.relief_m(i) / 80.F,
                   0.05F, 1.F);
               if (seed.uniform() > gathered) return;
               Stroke stroke = ground_stroke(scene, i, seed);
               stroke.source = static_cast<std::uint32_t>(*snow_pixel);
               stroke.depth_tolerance = tight_depth;
               stroke.order -= 12.F;
               const glm::vec2 centre =
                   position + scene.fall_line(position) * (0.4F * up * reach * scene.scale());
               if (!scene.on_canvas(centre)) return;
               const float aside = 0.2F * seed.normal();
               const float length = reach + seed.between(2.F, 6.F);
               lay_line(stroke, scene, centre, length, aside, 0.25F, true, seed);
               if (up > 0.F)
                 std::reverse(stroke.points.begin(), stroke.points.end());  // it thins out upwards
               take_brush(stroke, scene, seed.between(2.2F, 4.2F),
                          {.taper = 0.3F, .alpha = 0.85F, .bristle = 0.2F});
               stroke.colour = scene.colour(*snow_pixel, 0.25F * seed.normal(), paint_jitter, seed);
               out.push_back(stroke);
             });
}

std::vector<Stroke> rock_rubble(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.4F, stream,
             [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
               if (scene.class_at(i) != rock) return;
               const auto below = along_slope(scene, position, i, 4.F);
               if (!below || !grows(scene.class_at(*below))) return;
               // It gathers under gullies into cones; between them the wall meets the forest
               // directly.
               const float gathered = std::clamp(
                   0.35F + 0.9F * sheet_noise(scene, position, Stream::rubble_places, 8.0) -
                       scene.relief_m(i) / 60.F,
                   0.05F, 1.F);
               if (seed.uniform() > gathered) return;
               Stroke stroke = ground_stroke(scene, i, seed);
               stroke.depth_tolerance = 0.02F;
               // Fresh tracks are open between the trees, old ones covered by them.
               if (seed.uniform() < 0.35F * gathered)
                 stroke.order -= 3.F + 2.5F * scene.metres_per_unit(i);
               else
                 stroke.order -= 3.F;
               const float shortest = seed.between(5.F, 9.F);
               const float length = shortest + 9.F * gathered * seed.uniform();
               const glm::vec2 centre =
                   position + scene.fall_line(position) * (0.42F * length * scene.scale());
               if (!scene.on_canvas(centre)) return;
               lay_line(stroke, scene, centre, length, 0.22F * seed.normal(), 0.2F, true, seed);
               take_brush(stroke, scene, seed.between(1.3F, 2.8F),
                          {.taper = 0.35F, .alpha = 0.72F, .bristle = 0.5F, .wetness = 0.02F});
               stroke.colour = scene.colour(i, -0.35F + 0.4F * seed.normal(), paint_jitter, seed);
               out.push_back(stroke);
             });
}

std::vector<Stroke> rock_trees(const StrokeScene& scene, Stream stream) {
  return sow(
      scene, 3.4F, stream,
      [&](StrokeSeed& seed, glm::vec2 position, std::size_t i, std::vector<Stroke>& out) {
        if (scene.class_at(i) != rock) return;
        const auto is_forest = [&](std::size_t k) {
          return scene.class_at(k) == forest && on_same_slope(scene, i, k);
        };
        const float close = share_around(scene, position, near_units, is_forest);
        const float wide = share_around(scene, position, far_units, is_forest);
        if (close + wide <= 0.F) return;
        // They climb gullies and stand in rows on ledges. A patch too small to be a wall is
        // overgrown.
        const float gully = std::clamp(0.5F - scene.relief_m(i) / 40.F, 0.F, 1.F);
        const float gathered = std::clamp(
            0.5F + 0.75F * sheet_noise(scene, position, Stream::rock_tree_places, 6.0), 0.F, 1.3F);
        const float overgrown =
            std::clamp(2.5F * share_around(scene, position, 15.F, is_forest) - 1.5F, 0.F, 1.F);
        const float climbing = (0.75F * close + 0.45F * wide) * (0.4F + 0.8F * gully) * gathered;
        if (seed.uniform() > climbing + 0.5F * overgrown) return;
        const auto paint = forest_around(scene, position, i, close > 0.F ? near_units : far_units);
        if (!paint) return;
        const float width = seed.between(2.3F, 3.5F) * scene.scale();
        const float height = width * seed.between(1.7F, 2.3F);
        const float lighter = 0.2F * seed.normal() - 0.1F;
        std::vector<Stroke> tree;
        plant_spruce(scene, {position, width, height}, *paint, {lighter, 0.3F, 0.7F}, seed, tree);
        // Painted in the forest's colours, but at this position.
        const float step = scene.guidance.depth_m[i] - scene.guidance.depth_m[*paint];
        for (Stroke& stroke : tree) {
          stroke.depth_m += step;
          stroke.order += step - 15.F;  // over the rock it stands on
          out.push_back(stroke);
        }
      });
}

}  // namespace belvedere
