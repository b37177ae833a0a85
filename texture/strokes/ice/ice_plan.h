#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/guidance_buffers.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/ice/ice_ground.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// The ice on a whole sheet, which no window of it can determine. In units of the sheet, so that one
// plan serves every size.
struct IcePlan {
  IceFlow flow;
  std::vector<IceWay> ways;
};

// Plans the ice from a picture of the whole sheet; about one pixel per unit is sufficient. Needs
// depth, position, land cover, fall line, slope, footprint and relief_s. It uses the parameters
// pixels_per_unit (of this picture) and seed.
IcePlan plan_ice(const GuidanceBuffers& guidance, const StrokeParameters& parameters);

// Access of stroke kinds on ice to the plan of the sheet, for any window.

// The plan; Error(bug) if the scene has none.
const IcePlan& ice_of(const StrokeScene& scene);

// Unit direction of the ice at a position of the sheet, px.
glm::vec2 ice_direction(const StrokeScene& scene, glm::vec2 position);
// Lays a stroke of the length along the flow, with its centre at `position`, turned aside by
// aside_rad.
void lay_flow(Stroke& stroke, const StrokeScene& scene, glm::vec2 position, float length_px,
              float aside_rad);

inline constexpr glm::vec3 moraine_paint{0.53F, 0.515F, 0.525F};  // rubble on ice, at tone 1/2
inline constexpr glm::vec3 depth_of_ice{0.80F, 0.92F, 1.00F};     // ice is blue in depth: a factor
inline glm::vec3 by_tone(glm::vec3 paint, float tone) {
  return paint * (0.62F + 0.70F * std::clamp(tone, 0.F, 1.F));
}
// A stroke that starts on ice at pixel i, ends with it, and lies over its other paint.
Stroke ice_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed);
// An arc across the flow, its centre `sag_px` down the flow.
void lay_bow(Stroke& stroke, glm::vec2 centre, glm::vec2 across, glm::vec2 down, float length_px,
             float sag_px);

// Random numbers of a path, which depend only on its cell and their purpose: part 0 for the path as
// a whole, the others for its strokes.
StrokeSeed way_seed(const StrokeScene& scene, const IceWay& way, std::size_t part);
// Position k of a path on this sheet, px.
inline glm::vec2 way_place(const StrokeScene& scene, const IceWay& way, std::size_t k) {
  return way.positions[k] * scene.scale();
}
// The pixel under position k, to start a stroke from: none if no stroke is needed so far away, or
// if a picture with more pixels than the plan's shows another class or surface there.
std::optional<std::size_t> way_pixel(const StrokeScene& scene, const IceWay& way, std::size_t k);

// Calls draw(way) for the paths of a kind that come near the requested pixels, in the plan's order.
template <class Draw>
void along_ways(const StrokeScene& scene, Stream stream, Draw&& draw) {
  const PixelRect near = scene.seeded();
  for (const IceWay& way : ice_of(scene).ways) {
    if (way.stream != stream) continue;
    const glm::vec2 lowest = way.lowest * scene.scale();
    const glm::vec2 highest = way.highest * scene.scale();
    if (highest.x >= static_cast<float>(near.x0) && highest.y >= static_cast<float>(near.y0) &&
        lowest.x < static_cast<float>(near.x1) && lowest.y < static_cast<float>(near.y1))
      draw(way);
  }
}

}  // namespace belvedere
