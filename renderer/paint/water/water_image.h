#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/paint/air.h"
#include "renderer/paint/light.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/water/water_ground.h"

namespace belvedere {

// Share of light that still water reflects, unpolarized, where the cosine of the angle from its
// normal is 0…1: Fresnel's equations for an index of 1.333. 1 at grazing, 0.0204 straight down.
double water_fresnel(double cosine);
// The painted share: reflections are far stronger than Fresnel's where water is seen from above,
// fresnel^0.4. 0…1.
double painted_mirror(double cosine);

// The reflection in the water, stretched downwards by waves.
struct WaterImage {
  Grid<glm::vec3> colour;  // encoded sRGB
  Grid<float> share;       // visible share, 0…1; 0 where there is no water
  Grid<float> land;        // share of land, 0…1; the rest is sky
  Grid<glm::vec3> sky;     // reflection of ruffled water there
};

struct WaterImageParameters {
  LightParameters light;
  glm::dvec3 sun_direction{-0.612, 0.612, 0.5};  // unit
  AirParameters air;
  double pixels_per_unit = 1.0;
  double strength = 1.0;  // WaterParameters::mirror_share
};

// `sight`: of the pixels `rect` of the buffers, which extend water_image_margin_px above and below
// `wanted`, or to the sheet's edge. The result has the size of `wanted`. Colours are the palette's
// at the tone of sun and sky on the reflected position, seen through the air along the whole path,
// and darker and bluer than their source. Needs depth_m, land_cover, footprint_m and altitude_m.
WaterImage paint_water_image(const MirrorSight& sight, PixelRect rect,
                             const GuidanceBuffers& guidance, const Palette& palette,
                             const WaterImageParameters& parameters, PixelRect wanted);
int water_image_margin_px(double pixels_per_unit);

// Reflections in water: painters set the dark image of the far shore upside down into the far part
// of a lake, stretched downwards.
inline constexpr float open_water = 1e6F;
struct Mirrored {
  Grid<std::int32_t> source;  // index of the pixel whose image a water pixel shows; -1 where it
                              // shows the sky, and off the water
  Grid<float> share;          // 0…1, how strongly; 1 at the far shore
  Grid<float> to_far;  // units of the sheet up to the far shore; open_water if none is within reach
  Grid<float> to_near;  // the same down to the near shore
};

// Looks up each column of water for its far shore, at most reflection_units away, and from there
// the same distance up again, never across the next silhouette (a farther range is not reflected at
// this bank). A level shore has no image, the slope behind it has a weaker one. Narrow water
// reflects little: a brook shows the sky. Reach: reflection_margin_px(). Pixels outside `wanted`
// (empty: all) show nothing.
Mirrored find_reflections(const GuidanceBuffers& guidance, double pixels_per_unit,
                          PixelRect wanted = {});
int reflection_margin_px(double pixels_per_unit);

}  // namespace belvedere
