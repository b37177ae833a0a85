#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/rock/rock_view.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// Open ground that low plants cover.
bool is_turf(LandCoverClass id);

// Shares of rock, turf and snow around each wide pixel on its own surface, 0…1: spurs reach into
// the vegetation around them; snow and turf lie on treads where there is some nearby.
struct RockAround {
  Grid<float> rock;
  Grid<float> turf;
  Grid<float> snow;
};
// Computes the shares for the wide pixels in `wanted`; others hold 0. Reach: rock_around_reach
// (wide pixels).
RockAround look_around_rock(const WideView& wide, double pixels_per_unit, PixelRect wanted);
int rock_around_reach(double pixels_per_unit, int factor);

// Inputs for drawing the border of rock at a pixel.
struct RockPosition {
  LandCoverClass mapped = LandCoverClass::rock;  // from the land cover
  float slope_deg = 0.0F;
  float rock = 0.0F;  // shares around, 0…1
  float turf = 0.0F;
  float snow = 0.0F;
  float above = 0.0F;   // share of rock above minus share below, -1…1
  float stands = 0.0F;  // crest of a spur (+) or gully (-), -.6…+.6
  float funnel = 0.0F;  // as funnel_at
  float cones = 1.0F;   // as RockKind
  float bedded = 0.0F;  // how far beds rather than spurs shape the border, 0…1
  float bed = 0.0F;     // of a bed that stands out (+) or weathers back (-): -1…1
  float close = 0.0F;   // close_share
  float rib = 0.0F;     // 1 on the crest of a large spur, 0 beside it
  float wall = 0.0F;    // which near walls are bare: noise of deviation 1 over whole walls
};
// The class that a pixel shows after spurs extend into the meadows and debris climbs the gullies.
// Only rock, scree, snow, grass, shrub and pasture change; forest stays.
LandCoverClass rock_border(const RockPosition& position);
// Whether the bed at a position on the ground, m, stands out of turf, -1…1: beds of unlike
// thickness, with one dip. Noise of deviation 1.
float standing_bed(double altitude_m, double east_m, double north_m, float metres_per_unit,
                   float noise);
// Slope of snow, degrees, from which crests of rock may show, however far other rock is. Near walls
// are steeper than elevation data of their cell size can tell.
constexpr float steep_snow_deg(float close) { return 34.0F - 10.0F * close; }
// How much steeper ground of a class is where crests of rock show: turf and ice cling. None where
// no slope lays rock bare.
std::optional<float> clings_deg(LandCoverClass id, float close);

// Pinnacles and notches. Where rock stands in front of farther ground, its edge rises and sinks
// with the spurs beneath it: each pixel of the shifted picture shows a pixel of the traced one, in
// its own column.
struct CrestShift {
  Grid<std::int16_t> rows;  // rows from the pixel down (+) or up to the one that it shows
  Grid<float> front;        // as GuidanceBuffers::front, with the new edges
};

// For the pixels `wanted` of a window with traced depth, front, land cover and footprint; the
// result has their size. Reach: crest_margin_px up and down in the window, crest_view_margin_px in
// the wide view.
CrestShift shift_crests(const GuidanceBuffers& guidance, const WideView& wide,
                        const RockParameters& parameters, glm::ivec2 origin_px, PixelRect wanted);
int crest_margin_px(double pixels_per_unit);
int crest_view_margin_px(const RockParameters& parameters);
// Max distance of a shifted pixel's source, rows.
int crest_reach_px(double pixels_per_unit);

// The pixels `wanted` of traced guidance after the shift: every channel present is gathered; front
// is the shift's. `guidance` must extend crest_reach_px beyond them where the sheet does.
GuidanceBuffers gather_rows(const GuidanceBuffers& guidance, const CrestShift& shift,
                            PixelRect wanted);

}  // namespace belvedere
