#include <algorithm>
#include <cmath>

#include "texture/strokes/beds.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// How far the grain of a wall is turned from its fall line, rad: joints run slanting for a stretch, then change sides. A wall hatched in
// one direction throughout looks combed.
float joint_angle(const StrokeScene& scene, glm::vec2 place) { return 0.24F * sheet_noise(scene, place, Stream::rock_joints, 22.0); }

// Whether a place lies on the riser of a bed, 0…1.
struct Bed {
  float riser;
};
Bed bed_at(const StrokeScene& scene, std::size_t i) {
  // Beds thinner than a few strokes are not drawn one by one.
  const float shown = std::clamp(2.F - scene.metres_per_unit(i) * 6.F / bed_thickness_m, 0.F, 1.F);
  if (shown <= 0.F) return {0.F};
  const auto east_m = static_cast<float>(static_cast<double>(scene.guidance.position_m[i].x) + scene.guidance.origin_m.x);
  const float edge = bed_edge(bed_phase(scene.altitude_m(i), east_m, ground_noise(scene, i, Stream::bed_wavering, 210.0)));
  const float strength = bed_strength(ground_noise(scene, i, Stream::bed_strengths, 660.0));
  return {shown * strength * edge};
}

}  // namespace

std::vector<Stroke> rock_facets(const StrokeScene& scene, Stream stream) {
  return sow(scene, 4.6F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != rock) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    const float tone = scene.guidance.tone[i];
    stroke.depth_tolerance = tight_depth;
    stroke.tone = tone;
    stroke.order += 400.F + seed.uniform() * 100.F;
    const float oblique = seed.uniform() < 0.25F ? (seed.uniform() < 0.5F ? 0.8F : -0.8F) : 0.F;
    const float angle = 0.25F * seed.normal() + oblique + joint_angle(scene, place);
    const bool broad = seed.uniform() < 0.35F;  // a whole plane in a stroke or two
    lay_line(stroke, scene, place, broad ? seed.between(12.F, 22.F) : seed.between(6.F, 15.F), angle, 0.1F, true, seed);
    const float width = broad ? seed.between(6.F, 11.F) : seed.between(3.2F, 6.4F);
    take_brush(stroke, scene, width,
               {.taper = seed.between(0.55F, 1.05F), .alpha = broad ? 0.75F : 0.9F, .bristle = 0.08F, .wetness = 0.02F});
    const float m = tone > 0.60F   ? seed.between(0.1F, 0.6F)
                    : tone < 0.42F ? -seed.between(0.1F, 0.6F)
                                   : (seed.uniform() < 0.5F ? 0.55F : -0.55F);
    stroke.colour = scene.colour(i, broad ? 0.5F * m : m, paint_jitter * 1.1F, seed);
    if (broad) stroke.order += 200.F;
    out.push_back(stroke);
  });
}

std::vector<Stroke> rock_hatching(const StrokeScene& scene, Stream stream) {
  return sow(scene, 3.4F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != rock) return;
    const float edge = scene.base.accent[i];
    if (seed.uniform() > 0.30F + 0.60F * std::min(1.F, std::abs(edge))) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    stroke.order += seed.uniform() * 100.F;
    const float u = seed.uniform();
    lay_line(stroke, scene, place, 5.F + 12.F * u * u, joint_angle(scene, place) + 0.20F * seed.normal(), 0.12F, true, seed);
    const bool dark = seed.uniform() < (edge < 0.F ? 0.8F : 0.35F);
    take_brush(stroke, scene, dark ? seed.between(1.1F, 2.3F) : seed.between(1.2F, 2.5F), {.taper = 0.3F, .alpha = 0.75F, .bristle = 0.1F});
    stroke.colour = scene.colour(i, dark ? -seed.between(0.9F, 1.5F) : seed.between(0.7F, 1.3F), paint_jitter, seed);
    out.push_back(stroke);
  });
}

std::vector<Stroke> rock_ledges(const StrokeScene& scene, Stream stream) {
  return sow(scene, 5.5F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != rock) return;
    const Bed bed = bed_at(scene, i);
    // On a riser ledges run one behind the other; elsewhere beds crop out in stretches.
    const float anywhere = std::clamp(0.05F + 0.12F * sheet_noise(scene, place, Stream::ledge_places, 30.0), 0.01F, 0.25F);
    if (seed.uniform() > std::max(anywhere, 0.6F * bed.riser)) return;
    Stroke dark = ground_stroke(scene, i, seed);
    dark.depth_tolerance = tight_depth;
    dark.order -= 10.F;
    // All beds of a region dip to one side.
    const float dip = 0.22F * sheet_noise(scene, place, Stream::bed_dips, 45.0);
    const float angle = quarter_turn + dip + (bed.riser > 0.F ? 0.08F : 0.16F) * seed.normal();
    const float length = seed.between(5.F, 14.F) + 6.F * bed.riser;
    lay_line(dark, scene, place, length, angle, 0.3F, true, seed);
    const float width = seed.between(0.9F, 1.9F);
    take_brush(dark, scene, width, {.taper = 0.3F, .alpha = 0.56F, .bristle = 0.25F});
    dark.colour = scene.colour(i, -seed.between(0.9F, 1.4F), paint_jitter, seed);
    // The tread over the riser catches the light.
    Stroke lit = dark;
    const glm::vec2 up = scene.fall_line(place) * (-0.95F * width * scene.scale());
    for (auto& point : lit.points) point += up;
    lit.start_width *= 0.8F;
    lit.end_width *= 0.8F;
    lit.alpha = 0.25F + 0.35F * scene.guidance.tone[i];
    lit.colour = scene.colour(i, seed.between(0.6F, 1.1F), paint_jitter, seed);
    out.push_back(dark);
    out.push_back(lit);
  });
}

std::vector<Stroke> rock_snow(const StrokeScene& scene, Stream stream) {
  if (!scene.parameters.winter) return {};
  return sow(scene, 4.4F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != rock) return;
    // It holds in gullies and on ledges and slides off what is steeper than 60°.
    const float hollow = std::clamp(0.5F - scene.relief_m(i) / 60.F, 0.F, 1.F);
    const float holds = std::clamp((64.F - scene.slope_deg(i)) / 18.F, 0.F, 1.F);
    const float gathered = std::clamp(0.55F + 0.6F * sheet_noise(scene, place, Stream::rock_snow_places, 10.0), 0.F, 1.F);
    const float on_bed = bed_at(scene, i).riser;
    if (seed.uniform() > holds * std::max(1.5F * hollow * gathered, 0.7F * on_bed)) return;
    Stroke stroke = ground_stroke(scene, i, seed);
    stroke.depth_tolerance = tight_depth;
    stroke.order -= 12.F;  // over every stroke of the wall, under the trees before it
    const bool ledge = seed.uniform() < 0.25F + 0.6F * on_bed;
    const float angle = (ledge ? quarter_turn : 0.F) + joint_angle(scene, place) + 0.2F * seed.normal();
    lay_line(stroke, scene, place, ledge ? seed.between(4.F, 10.F) : seed.between(6.F, 20.F), angle, 0.2F, true, seed);
    take_brush(stroke, scene, seed.between(1.2F, 3.2F), {.taper = 0.2F, .alpha = 0.72F, .bristle = 0.45F, .wetness = 0.02F});
    const float value = 0.02F * seed.normal();
    stroke.colour = through_air(scene, i, fresh_snow(scene.guidance.tone[i]) + value);
    out.push_back(stroke);
  });
}

std::vector<Stroke> rock_fissures(const StrokeScene& scene, Stream stream) {
  return sow(scene, 6.2F, stream, [&](StrokeSeed& seed, glm::vec2 place, std::size_t i, std::vector<Stroke>& out) {
    if (scene.class_at(i) != rock) return;
    const float tone = scene.guidance.tone[i];
    // Shade swallows most of them.
    if (seed.uniform() > std::clamp(0.2F + 1.2F * (tone - 0.35F), 0.15F, 0.6F)) return;
    Stroke crack = ground_stroke(scene, i, seed);
    crack.depth_tolerance = 0.012F;
    crack.order -= 5.F;
    // Two sets of joints: down the wall, and slanting to one side for a stretch.
    const bool slanting = seed.uniform() < 0.22F;
    const float slant = sheet_noise(scene, place, Stream::rock_slants, 26.0) < 0.F ? -0.75F : 0.75F;
    const float angle = joint_angle(scene, place) + (slanting ? slant + 0.12F * seed.normal() : 0.22F * seed.normal());
    const float length = slanting ? seed.between(4.F, 11.F) : seed.between(7.F, 21.F);
    lay_line(crack, scene, place, length, angle, 0.25F, true, seed);
    const float width = seed.between(1.0F, 1.7F);
    take_brush(crack, scene, width, {.alpha = 0.66F});
    crack.end_width = 0.5F * scene.scale();  // all run out equally fine
    crack.colour = scene.colour(i, -seed.between(1.25F, 1.5F), paint_jitter, seed);
    out.push_back(crack);
    if (seed.uniform() > 0.45F) return;
    // The edge behind the crack turns to the light.
    Stroke edge = crack;
    const auto away = static_cast<float>(-scene.parameters.sun_side);
    for (auto& point : edge.points) point.x += away * 1.15F * scene.scale();
    edge.start_width = 0.9F * scene.scale();
    edge.alpha = 0.3F + 0.35F * tone;
    edge.order -= 1.F;
    edge.colour = scene.colour(i, seed.between(0.9F, 1.4F), paint_jitter, seed);
    out.push_back(edge);
  });
}

}  // namespace belvedere
