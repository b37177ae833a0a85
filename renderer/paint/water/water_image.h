#pragma once

#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/paint/air_parameters.h"
#include "renderer/paint/light.h"
#include "renderer/paint/palette.h"
#include "renderer/trace/water/water_mirror.h"

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

}  // namespace belvedere
