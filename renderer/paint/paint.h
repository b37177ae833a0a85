#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "renderer/paint/palette.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Air, fields and hue drift of look/recipe.md: what turns ramps into the base picture. Distances are along the ray.
struct BaseParameters {
  double haze = 0.85;             // greatest share of air, 0…1
  double haze_from_m = 34000.0;   // air begins here, and the foreground's warmth ends about twice as far; ≥ 0
  double haze_scale_m = 62000.0;  // over this distance more the air closes to 1 - 1/e; > 0
  double haze_floor_m = 600.0;    // altitude up to which air is densest
  double range_mist = 1.0;        // separation of ranges, 0…3
  double warm_near = 1.0;         // 0…3
  double hue_drift = 1.0;         // 0…3: slow changes of hue over the ground, fields
  double rim_fade_m = 4000.0;     // over this distance the terrain stands ever deeper in air towards its end; 0 off
  double clouds = 1.0;            // 0 (none)…2
  double horizon_px = 0.0;        // row of the horizon in the whole picture (skyline_row_px of sky.h); 0: 0.18 of its height
  double sun_image_x = 1.0;       // as in ToneParameters
  double pixels_per_unit = 1.0;
  std::uint64_t seed = 1;
};

// Base picture (encoded sRGB) at the pixel's tone and at ∓ .17, with accents, tree density and haze; sky pixels get sky and clouds.
// Reads depth, position, altitude, land cover, tone and relief_s, and footprint where it is there (fields too small to see then fade).
// `origin_px`, `picture_size`: where the buffers lie in the whole picture. Local up to base_margin_px(): a part with that margin equals
// the whole bit for bit.
PaintGround make_paint_ground(const GuidanceBuffers& guidance, const Palette& palette, const BaseParameters& parameters,
                              glm::ivec2 origin_px, glm::ivec2 picture_size, Progress& progress);
int base_margin_px(const BaseParameters& parameters);

// Share of air in front of a place, 0…1, before the palette's share.
double haze_share(const BaseParameters& parameters, double depth_m, double altitude_m);

// An exemplar with everything a composite needs: where buffers meet pictures.
struct PaintedExemplar {
  Exemplar exemplar;        // what synthesis compares
  Grid<glm::vec3> picture;  // encoded sRGB, full depth, without trees and sky strokes
  Grid<glm::vec3> base;     // its base picture, encoded sRGB; empty for a scan
};

// Strokes overlap the borders of classes: rock flecks lie on snow, grass reaches into scree. What counts for copying is whose paint a pixel
// shows, in the exemplar and in the target alike: labels of the painted class, and the base colour of where that paint came from.
struct PaintedClasses {
  Grid<LandCoverClass> land_cover;
  Grid<glm::vec3> base;  // encoded sRGB
};
PaintedClasses find_painted_classes(const Grid<std::uint32_t>& sources, const GuidanceBuffers& guidance, const Grid<glm::vec3>& base);

// Guides for synthesis from buffers, quantized alike for exemplar and target, each to 0…255:
//   altitude     20 m a step from 0 m           tone          0…1
//   distance     log from 500 m to 500 km       shadow        0 in shadow … 1 lit
//   slope        0…90°                          fall_line_x/y -1…1, 0 at 127.5 rounded up
// A channel the buffers lack is left out. Labels are the ids of `land_cover`: the buffers' own or the painted ones; sky is 255, because the
// sky is painted, not copied.
GuideStack make_guide_stack(const GuidanceBuffers& guidance, const Grid<LandCoverClass>& land_cover);

}  // namespace belvedere
