#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "renderer/paint/palette.h"
#include "renderer/trace/terrain_model.h"

namespace belvedere {

// Colours that the ground has of its own (LandCover::colours): of surface layers, or of a picture from above. Light stays the palette's: a
// class's ramp is moved as a whole until it has the ground's colour at the tone of level open ground.
struct GroundTint {
  // One ground's colours, and means of 2 × 2 of them, and of these, …: what is seen from afar is the mean of its ground.
  struct Ground {
    const TerrainModel* model;
    PixelRect part;  // of a window: where its values hold, in its cells; empty: everywhere
    std::vector<Grid<GroundColour>> means;
  };
  std::vector<Ground> grounds;  // the whole, then windows in ever finer cells
  double lightness = 1.0;       // what the colours' lightness is multiplied by, so that the whole is as light as the palette paints it
  double share = 1.0;           // how far ramps go over, 0…1
};

// Null where the terrain has no colours. The terrain must outlive it.
std::shared_ptr<const GroundTint> make_ground_tint(const TerrainModel& terrain, const Palette& palette, double share);

// The colour at a place of the scene's CRS, of which a pixel shows `footprint_m`: encoded sRGB 0…1, and how much of it is known, 0…1.
glm::vec4 ground_colour_at(const GroundTint& tint, glm::dvec2 place_m, double footprint_m);

// Depth of the lake at a place of the scene's CRS whose bed is seen, m; 0 where there is none.
float lake_depth_at(const GroundTint& tint, glm::dvec2 place_m);

// How a ramp is moved at a place, in OKLab: its lightness by a factor, its hue by a way that is shorter in shade.
struct TintShift {
  float share = 0.F;                     // 0: not at all
  double factor = 1.0;                   // of lightness
  glm::dvec2 chroma{0.0};                // what is added to a, b where the ramp is as light as `reference` …
  double reference_l = 1.0;              // … which is its lightness at the tone of level open ground
  glm::vec3 over(glm::vec3 ramp) const;  // encoded sRGB
};
TintShift tint_shift(const GroundTint& tint, const Palette& palette, LandCoverClass id, double altitude_m, glm::dvec3 place_m,
                     double footprint_m);

}  // namespace belvedere
