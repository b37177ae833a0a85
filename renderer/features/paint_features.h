#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "renderer/features/drawn_features.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/paint_parts.h"

namespace belvedere {

// The ground under features and its light. All grids cover the same rectangle of the sheet.
struct FeatureGround {
  const GuidanceBuffers& guidance;   // depth_m, tone, land_cover
  const Grid<glm::vec3>& base;       // encoded sRGB: the colour that air fades to
  const Grid<float>& haze;           // 0…1
  const Grid<float>& seen_ground;    // share of each pixel not covered by standing objects
  const Grid<float>& seen_overhead;  // the same for objects nearer than find_overhead's distance;
                                     // empty: there are none
  // Rows from each pixel down to where its ground was traced (CrestShift::rows): lines on the
  // ground follow it. Null: no shift.
  const Grid<std::int16_t>* crest_rows = nullptr;
};

// Paints roads, runs and lifts on a rectangle of the sheet (encoded sRGB): beds, bands, all casings
// by rank, all fills by rank, lifts over all. Lines of one kind form one shape, so that crossings
// and joints join and the order of files does not matter. Each pixel depends only on its position
// on the sheet. Roads and runs lie on the ground of their own distance, below standing objects;
// lifts are in front of everything farther and behind nearer standing objects. Only `asked` is
// painted, a part of the rectangle in pixels of the sheet. `parts`, where given, takes all of it as
// PaintPart::features; it must contain `asked`, in pixels of the picture.
void paint_features(Grid<glm::vec3>& picture, const DrawnFeatures& features,
                    const FeatureGround& ground, PixelRect rect, PixelRect asked,
                    PaintParts* parts = nullptr);

// Calls use(kind, x, y, share) for the pixels of a rectangle of the sheet that a coat of lines
// covers, at each pixel from the lowest coat to the topmost; by several threads, of which none has
// the pixels of another. `crest_rows` as in FeatureGround.
using UseCoat = std::function<void(int kind, int x, int y, float share)>;
void visit_coats(const DrawnFeatures& features, const Grid<float>& depth_m, PixelRect rect,
                 const Grid<std::int16_t>* crest_rows, const UseCoat& use);

// 1 where nothing may stand, because a line, a river, a rope above it or a house needs the space:
// on pixels of that line's own ground. `crest_rows` as in FeatureGround.
Grid<std::uint8_t> find_cleared(const DrawnFeatures& features, const Grid<float>& depth_m,
                                PixelRect rect, const Grid<std::int16_t>* crest_rows = nullptr);

// Distance from the eye of the nearest rope, pylon or station at each pixel, m; infinite without
// one; empty if none touches the rectangle.
Grid<float> find_overhead(const DrawnFeatures& features, PixelRect rect);

}  // namespace belvedere
