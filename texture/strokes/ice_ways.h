#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>

#include "texture/strokes/ice_plan.h"
#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// What kinds of stroke on ice take from the plan of the sheet, wherever their window lies.

// The plan; Error(bug) where the scene has none.
const IcePlan& ice_of(const StrokeScene& scene);

// Unit direction of the ice at a place of the sheet, px.
glm::vec2 ice_direction(const StrokeScene& scene, glm::vec2 place);
// Lays a stroke of the length along the flow, its middle at `place`, turned aside by aside_rad.
void lay_flow(Stroke& stroke, const StrokeScene& scene, glm::vec2 place, float length_px, float aside_rad);

// Random numbers of a way, drawn by its cell and by what they are for alone: part 0 its looks as a whole, the others its strokes.
StrokeSeed way_seed(const StrokeScene& scene, const IceWay& way, std::size_t part);
// Place k of a way on this sheet, px.
inline glm::vec2 way_place(const StrokeScene& scene, const IceWay& way, std::size_t k) { return way.places[k] * scene.scale(); }
// The pixel under place k, to grow a stroke from: none where no stroke is wanted so far away, and where a picture that shows more than the
// plan's has another class or surface there.
std::optional<std::size_t> way_pixel(const StrokeScene& scene, const IceWay& way, std::size_t k);

// Calls draw(way) for the ways of a kind that come near what is asked for, in the plan's order.
template <class Draw>
void along_ways(const StrokeScene& scene, Stream stream, Draw&& draw) {
  const PixelRect near = scene.seeded();
  for (const IceWay& way : ice_of(scene).ways) {
    if (way.stream != stream) continue;
    const glm::vec2 lowest = way.lowest * scene.scale();
    const glm::vec2 highest = way.highest * scene.scale();
    if (highest.x >= static_cast<float>(near.x0) && highest.y >= static_cast<float>(near.y0) && lowest.x < static_cast<float>(near.x1) &&
        lowest.y < static_cast<float>(near.y1))
      draw(way);
  }
}

}  // namespace belvedere
