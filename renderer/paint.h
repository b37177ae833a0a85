#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "renderer/base/guidance_buffers.h"
#include "renderer/base/progress.h"
#include "renderer/palette.h"
#include "texture/exemplar.h"
#include "texture/stroke_painter.h"

namespace belvedere {

// Air, fields and hue drift of look/recipe.md: what turns ramps into the base picture.
struct BaseParameters {
  double haze = 0.85;            // greatest share of air, 0…1
  double haze_from_m = 34000.0;  // ≥ 0
  double haze_scale_m = 62000.0; // > 0
  double range_mist = 1.0;       // separation of ranges, 0…3
  double warm_near = 1.0;        // 0…3
  double hue_drift = 1.0;        // 0…3
  double pixels_per_unit = 1.0;
  std::uint64_t seed = 1;
};

// Base picture (encoded sRGB) at the pixel's tone and at ∓ .17, with accents, tree density and haze; sky pixels get sky and clouds.
// `origin_px`, `picture_size`: where the buffers lie in the whole picture. Local up to base_margin_px().
PaintGround make_paint_ground(const GuidanceBuffers& guidance, const Palette& palette, const BaseParameters& parameters,
                              glm::ivec2 origin_px, glm::ivec2 picture_size, Progress& progress);
int base_margin_px(const BaseParameters& parameters);

// An exemplar with everything a composite needs: where buffers meet pictures.
struct PaintedExemplar {
  Exemplar exemplar;             // what synthesis compares
  Grid<glm::vec3> picture;       // encoded sRGB, full depth, without trees and sky strokes
  Grid<glm::vec3> base;          // its base picture, encoded sRGB; empty for a scan
};

// Guides for synthesis from buffers, quantized alike for exemplar and target: altitude, tone, distance, shadow, slope, fall line.
GuideStack make_guide_stack(const GuidanceBuffers& guidance);

}  // namespace belvedere
