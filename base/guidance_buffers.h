#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "base/grid.h"
#include "base/image.h"
#include "base/land_cover_class.h"
#include "base/math.h"

namespace belvedere {

// How the picture sees the ground.
struct ViewChannels {
  Grid<float> depth_m;   // distance from the eye along the ray; +inf is sky
  Grid<float> coverage;  // part of the pixel that is terrain, 0…1
  Grid<float> front;  // part of the pixel's samples on the winning surface, 0…1; < 1 at depth edges
  Grid<float> silhouette;   // depth discontinuity, 0…1; on the nearer side
  Grid<float> footprint_m;  // ground metres per pixel
  Grid<glm::vec2>
      fall_line;  // unit direction of steepest descent in the image (x right, y down); 0 where flat
  Grid<float> rim_m;  // distance on the ground to the edge of the known terrain
};

// The ground itself, at the position that each pixel sees.
struct GroundChannels {
  glm::dvec3 origin_m{0.0};    // origin of position_m, scene CRS
  Grid<glm::vec3> position_m;  // before deformation, scene CRS (x east, y north, z altitude),
                               // relative to the origin
  Grid<glm::vec3> normal;  // unit; generalized, exaggerated surface, not bent: the light must not
                           // follow the bend
  Grid<glm::vec3>
      normal_detail;  // unit; ungeneralized, exaggerated surface (used for ribs of rock)
  Grid<glm::vec3> normal_smooth;  // unit; generalized surface after a Gaussian of 120 m
  Grid<float> altitude_m;         // above the vertical datum, of the undeformed, ungeneralized DEM
  Grid<LandCoverClass> land_cover;
  Grid<float> slope_deg;        // of the unexaggerated DEM after a Gaussian of 60 m
  Grid<float> aspect_deg;       // clockwise from north, downhill
  Grid<float> ridge;            // signed: ridge > 0, valley < 0
  Grid<float> relief_s_m;       // height above the Gaussian mean of about 180 m
  Grid<float> relief_m_m;       // … of about 750 m
  Grid<float> relief_l_m;       // … of about 1.8 km
  Grid<float> valley_height_m;  // height above the lowest ground within 900 m
  Grid<float> built;  // building density: 0 open land, .3 a village, 1 the centre of a large town
  Grid<glm::vec2> grain;  // direction of fields and streets on the ground: (cos 2a, sin 2a) times
                          // the confidence, 0…1; a from east
  Grid<float> flow;       // base-10 logarithm of the upstream area in m²
};

// Relief that the DEM does not resolve: of rock (renderer/rock), and of open ground seen from near
// (renderer/close), which has only planes and tone. 0 elsewhere.
struct RockChannels {
  Grid<float> rock_height;  // units of the sheet (0.5 mm)
  Grid<std::uint32_t>
      rock_facet;  // number of the plane of a pixel; planes of one large spur share the upper half
  Grid<float> rock_tone;  // light on that relief, before the picture's; on near ground the tone
                          // that its forms add
  Grid<glm::vec2> rock_cover;  // shares of turf and of snow on it, 0…1
};

// Light, and the picture before strokes.
struct LightChannels {
  Grid<float> shadow;    // 1 lit by the sun, 0 in cast shadow
  Grid<float> sky_view;  // part of the sky seen, 0…1
  Grid<float> tone;      // the scalar light that indexes palettes, 0…1
  Image base;            // strokeless base picture, scene-linear
};

// Paintings whose strokes are known. Strokes overlap the borders of classes, so the paint of a
// pixel does not always belong to the class at its position.
struct PaintChannels {
  Grid<LandCoverClass> painted_class;  // class with the thickest paint
  Grid<std::uint32_t> painted_from;    // row-major index of the pixel of that class at which its
                                       // thickest stroke starts
  Grid<std::uint32_t> stroke;          // number of the stroke on top, from 1; 0 is bare canvas
  Grid<std::uint32_t> ground_from;     // as painted_from, in the layer without trees and houses
};

// Per-pixel description of a picture, both of a synthesis target and of an exemplar. It is in base
// because texture/ and renderer/ both use it. All grids have the picture's size, or are empty if a
// channel is absent. All values of a pixel come from the same sample, the one that won the pixel,
// so nothing mixes across a silhouette. Names in files, units and sky values: guidance_channels.h.
struct GuidanceBuffers : ViewChannels, GroundChannels, RockChannels, LightChannels, PaintChannels {
  int width() const { return depth_m.width(); }
  int height() const { return depth_m.height(); }
  bool is_sky(std::size_t i) const {
    return !(depth_m[i] < std::numeric_limits<float>::infinity());
  }
};

// How near ground is seen, 0…1, by the metres of it in a unit of the sheet (0.5 mm): at 1 its forms
// are larger than the elevation data resolve, and are invented.
inline float close_share(float metres_per_unit) {
  constexpr float near_m = 14.0F;
  constexpr float far_m = 25.0F;
  return 1.0F - smoothstep(near_m, far_m, metres_per_unit);
}

}  // namespace belvedere
