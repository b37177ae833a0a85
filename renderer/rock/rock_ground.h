#pragma once

#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "renderer/trace/wide_view.h"

namespace belvedere {

// How much rock, turf and snow lies about each wide pixel on its own surface, 0…1: spurs reach into what grows around, snow and turf lie on
// treads as far as there is some near.
struct RockAround {
  Grid<float> rock;
  Grid<float> turf;
  Grid<float> snow;
};
// Of wide pixels in `wanted`; others hold 0. Reach: rock_around_reach (wide pixels).
RockAround look_around_rock(const WideView& wide, double pixels_per_unit, PixelRect wanted);
int rock_around_reach(double pixels_per_unit, int factor);

// What is so of a pixel where the border of rock is drawn.
struct RockPlace {
  LandCoverClass mapped = LandCoverClass::rock;  // by the land cover
  float slope_deg = 0.0F;
  float rock = 0.0F;  // shares around, 0…1
  float turf = 0.0F;
  float snow = 0.0F;
  float above = 0.0F;   // how much more rock lies above than below, -1…1
  float stands = 0.0F;  // crest of a spur (+) or gully (-), -.6…+.6
  float funnel = 0.0F;  // as funnel_at
  float cones = 1.0F;   // as RockKind
};
// The class that a pixel shows once spurs stand out into the meadows and debris climbs the gullies. Only rock, scree, snow, grass, shrub
// and pasture change places; forest stays.
LandCoverClass rock_border(const RockPlace& place);
// Snow so steep, degrees, that crests of rock may stand out of it, wherever the next rock is.
inline constexpr float steep_snow_deg = 34.0F;

}  // namespace belvedere
