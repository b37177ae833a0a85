#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "texture/strokes/ice/ice_ways.h"
#include "texture/strokes/stroke_kinds.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

constexpr float begins_over = 9.F;   // positions
constexpr float widest_dirt = 20.F;  // dirty ice around a moraine, units

// Rubble on ice between two positions of a moraine: dabs, dense in its middle, with the light of a
// low ridge.
void strew_rubble(const StrokeScene& scene, const IceWay& way, std::size_t k, std::size_t here,
                  StrokeSeed& seed, std::vector<Stroke>& out) {
  const float scale = scene.scale();
  const glm::vec2 from = way_place(scene, way, k);
  const glm::vec2 along = way_place(scene, way, k + 1) - from;
  const glm::vec2 across = way.across[k];
  const float half = way.half_width[k];
  // Seen at a grazing angle there is room for few stones; the first ones lie far apart.
  const float room = std::clamp(1.4F * glm::length(across), 0.35F, 1.F);
  const float begun = std::min(1.F, (static_cast<float>(k) + 1.F) / begins_over);
  const float sun = scene.sun_side(here);
  const float right = across.x >= 0.F ? 1.F : -1.F;
  // Where it is broad it lies in strands that part and join, each of them in heaps.
  const int strands = 1 + static_cast<int>(std::min(3.F, half / 2.2F));
  for (int strand = 0; strand < strands; ++strand) {
    const float slot =
        2.F * (static_cast<float>(strand) + 0.5F) / static_cast<float>(strands) - 1.F;
    const glm::vec2 apart = from + glm::vec2(900.F * scale * static_cast<float>(strand), 0.F);
    const float wander = sheet_noise(scene, apart, Stream::rubble_places, 16.0);
    const float middle = strands > 1 ? 0.66F * slot + 0.36F * wander : 0.12F * wander;
    const float spread = strands > 1 ? 0.38F : 1.1F;
    const float heap = std::clamp(
        0.65F + 0.75F * sheet_noise(scene, apart, Stream::rubble_places, 7.0) + 0.25F * wander, 0.F,
        1.4F);
    const int count = static_cast<int>(
        heap * room * begun * (3.F + 4.2F * half) / static_cast<float>(strands) + 0.5F);
    for (int n = 0; n < count; ++n) {
      const float a = seed.between(-1.F, 1.F);
      const float b = seed.uniform();
      const float aside = middle + spread * a * (0.3F + 1.1F * b * b);
      const float ahead = seed.uniform();
      const float size = seed.between(0.8F, 2.0F);
      const float length = seed.between(0.9F, 2.2F) * size;
      const float turn = 0.45F * seed.normal();
      const float grey = 0.03F + 0.055F * seed.normal();
      const glm::vec2 at = from + along * ahead + across * (aside * half * scale);
      // On its own ground: seen at a grazing angle the next is far away.
      if (!scene.on_canvas(at)) continue;
      const std::size_t own = scene.pixel(at);
      if (scene.class_at(own) != way.land_cover) continue;
      Stroke dab = ice_stroke(scene, own, seed);
      const glm::vec2 way_of = turned(glm::normalize(along), turn_by(turn));
      set_line(dab, at - way_of * (0.5F * length * scale), at + way_of * (0.5F * length * scale),
               size * scale, 0.7F * size * scale);
      const float edge = std::abs(aside - middle) / spread;
      dab.alpha = std::max(0.10F, 0.50F - 0.32F * edge) * (0.4F + 0.6F * begun);
      // The side that faces the sun is light.
      const float ridge = std::min(1.F, half / 2.F) * 0.10F * aside * right * sun;
      dab.colour = through_air(scene, own,
                               by_tone(moraine_paint, scene.guidance.tone[own]) + grey +
                                   ridge * glm::vec3(1.F, 0.95F, 0.85F));
      out.push_back(dab);
    }
  }
}

}  // namespace

std::vector<Stroke> glacier_moraines(const StrokeScene& scene, Stream stream) {
  std::vector<Stroke> out;
  along_ways(scene, stream, [&](const IceWay& way) {
    const std::size_t count = way.positions.size();
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const auto here = way_pixel(scene, way, k);
      if (!here) continue;
      StrokeSeed seed = way_seed(scene, way, 1 + k);
      // Dirty ice under it, broader the farther down.
      if (k % 2 == 0 && k + 3 < count) {
        Stroke band = ice_stroke(scene, *here, seed);
        band.point_count = 4;
        for (std::size_t j = 0; j < 4; ++j) band.points[j] = way_place(scene, way, k + j);
        const float seen = glm::length(way.across[k]);
        const float dirty = 0.06F + 0.09F * std::min(1.F, static_cast<float>(k) / 25.F);
        take_brush(band, scene, std::clamp(3.6F * way.half_width[k] * seen, 1.2F, widest_dirt),
                   {.taper = 0.95F,
                    .alpha = dirty,
                    .bristle = 0.1F,
                    .wetness = 0.02F,
                    .load = 0.4F,
                    .edge = 0.15F});
        band.colour = through_air(scene, *here, by_tone(moraine_paint, scene.guidance.tone[*here]));
        out.push_back(band);
      }
      // In winter a line of stones remains.
      if (scene.parameters.winter && seed.uniform() < 0.6F) continue;
      strew_rubble(scene, way, k, *here, seed, out);
    }
  });
  return out;
}

}  // namespace belvedere
