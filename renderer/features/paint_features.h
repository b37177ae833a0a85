#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "renderer/features/drawn_features.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/paint_parts.h"

namespace belvedere {

// What features are painted on and by. All grids hold the same rectangle of the sheet.
struct FeatureGround {
  const GuidanceBuffers& guidance;  // depth_m, tone, land_cover
  const Grid<glm::vec3>& base;      // encoded sRGB: what air fades to
  const Grid<float>& haze;          // 0…1
  const Grid<float>& seen_ground;   // share of each pixel that nothing standing covers
  const Grid<float>& seen_hung;     // the same of what stands nearer than find_hung says; empty: nothing does
  // How many rows below each pixel the ground that it shows was traced (CrestShift::rows): ways go along with it. Null: right there.
  const Grid<std::int16_t>* crest_rows = nullptr;
};

// Paints ways, runs and lifts on a rectangle of the sheet (encoded sRGB): beds, bands, all casings by rank, all fills by rank, lifts over
// all. Lines of one kind make one shape, so that crossings and joints join and the order of files does not matter. Each pixel hangs on the
// sheet's place alone. Ways lie on the ground of their own distance, under what stands; lifts before all that is farther, behind what
// stands nearer. Only `asked` is painted, a part of the rectangle in pixels of the sheet. `parts`, where given,
// takes all of it as PaintPart::features; it must hold `asked`, in pixels of the picture.
void paint_features(Grid<glm::vec3>& picture, const DrawnFeatures& features, const FeatureGround& ground, PixelRect rect, PixelRect asked,
                    PaintParts* parts = nullptr);

// 1 where nothing that stands up may grow, because a line, a river, a rope above it or a house needs the place: on pixels of that line's
// own ground. `crest_rows` as of FeatureGround.
Grid<std::uint8_t> find_cleared(const DrawnFeatures& features, const Grid<float>& depth_m, PixelRect rect,
                                const Grid<std::int16_t>* crest_rows = nullptr);

// How far from the eye the nearest rope, pylon or station at each pixel is, m; infinite where there is none; empty where none touches the
// rectangle.
Grid<float> find_hung(const DrawnFeatures& features, PixelRect rect);

}  // namespace belvedere
