#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/paint/air_parameters.h"
#include "renderer/paint/palette.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"

namespace belvedere {

// The sky of the base picture: a gradient from the palette, thin level veils, and banks of cloud over level bases, which shrink towards
// the horizon. No two clouds are alike, and every seed has a sky of its own. Sizes follow the height of the sky, so all resolutions look
// alike.
struct SkyParameters {
  glm::ivec2 picture_size{CameraParameters{}.width, CameraParameters{}.height};  // px, the whole picture
  double horizon_px = 198.0;               // row of the horizon in the whole picture, > 0; see skyline_row_px
  double clouds = AirParameters{}.clouds;  // how many, 0 (none)…2
  double sun_image_x = 1.0;                // > 0: the right sides of clouds are lit, -1…1
  std::uint64_t seed = 1;
};

// Gradient at a place from the top of the picture (0) to the horizon (1); clamped. Encoded sRGB.
glm::vec3 sky_gradient(const Palette& palette, double place);
// What is seen where there is no terrain: the sky, and below the horizon (place > 1) the haze of ground that no data cover.
glm::vec3 air_beyond(const Palette& palette, double place);

// A rounded head of a cloud; a cloud is a heap of them over a level base. In pixels of the whole picture.
struct CloudHead {
  glm::vec2 centre;
  glm::vec2 radius;
};
struct Cloud {
  float base_px;                 // row of the level base
  glm::vec2 from, to;            // box that holds all of it
  float opacity;                 // 0…1
  int grain;                     // how fine its edges are: 0 near … 3 far, each half the one before
  std::vector<CloudHead> heads;  // far to near
};
// All clouds of a picture, far to near: a pure function of the parameters.
std::vector<Cloud> make_clouds(const SkyParameters& parameters);

// Encoded sRGB at the sky pixels of a part of the picture (depth +inf); other pixels hold 0. Every pixel stands alone.
Grid<glm::vec3> make_sky(const Grid<float>& depth_m, const Palette& palette, const SkyParameters& parameters, glm::ivec2 origin_px);

// Median over the columns of the topmost terrain row, for buffers that hold the whole picture's skyline; `fallback_px` where no column
// has terrain.
double skyline_row_px(const GuidanceBuffers& guidance, double fallback_px);
// The same before anything is traced, by a few thousand rays in 64 columns: the horizon_px of pictures made in parts. A column's
// skyline is sought from the top in steps of 1/96 of the height, so a needle between two steps may be missed; then halved to a pixel.
double skyline_row_px(const Camera& camera, const Tracer& tracer, double fallback_px);

}  // namespace belvedere
