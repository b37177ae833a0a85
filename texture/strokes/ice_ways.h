#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>

#include "texture/strokes/ice_plan.h"
#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Access of stroke kinds on ice to the plan of the sheet, for any window.

// The plan; Error(bug) if the scene has none.
const IcePlan& ice_of(const StrokeScene& scene);

// Unit direction of the ice at a position of the sheet, px.
glm::vec2 ice_direction(const StrokeScene& scene, glm::vec2 position);
// Lays a stroke of the length along the flow, with its centre at `position`, turned aside by
// aside_rad.
void lay_flow(Stroke& stroke, const StrokeScene& scene, glm::vec2 position, float length_px,
              float aside_rad);

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
