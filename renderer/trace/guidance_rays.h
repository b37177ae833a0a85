#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/grid.h"
#include "renderer/trace/tracer.h"

namespace belvedere {

// Part of trace_guidance: which rays are traced, and the light that follows from them. The picture
// is traced in blocks of 8 × 8 pixels at multiples of 8 in the whole picture, whatever part is
// requested, so a ray always has the same neighbours in its bundle.
constexpr int trace_block_px = 8;
constexpr int trace_block_pixels = trace_block_px * trace_block_px;

// Pixel i of a block, as four consecutive bundles of 4 × 4 pixels.
constexpr glm::ivec2 block_pixel(int i) {
  return {(i / 16 % 2) * 4 + i % 4, (i / 32) * 4 + i % 16 / 4};
}

// n = 1, 4, 9 or 16 positions in a pixel, 0…1, on a rotated grid: no two share a column or a row of
// the n × n fine grid.
std::vector<glm::dvec2> pixel_sample_positions(int n);
// K positions in the unit disc, in strata of equal area (Vogel's spiral).
std::vector<glm::dvec2> disc_positions(int count);

// Directions of the upper hemisphere, cosine weighted, distributed over the 16 pixels of each 4 × 4
// square of the picture: a pixel traces `per_pixel` of them, the square 16 times as many.
// (Interleaved sampling, Keller & Heidrich 2001: with the same 16 directions for all pixels, 16
// outlines of every ridge would appear on the ground.)
struct SkyDirection {
  glm::dvec3 direction;
  int lane;  // which pixel of the square: x % 4 + 4 (y % 4)
};
std::vector<SkyDirection> sky_directions(int per_pixel);

// The ground in the pixels of a block.
struct BlockSurface {
  struct Pixel {
    bool terrain = false;
    double distance_m = 0.0;
    glm::dvec3 start{0.0};  // of secondary rays, deformed world
    glm::dvec3 facet_normal{0.0};
  };
  std::array<Pixel, trace_block_pixels> pixels;
  glm::ivec2 corner{0};  // of the block in the whole picture, px
};
using BlockValues = std::array<float, trace_block_pixels>;

// Share of the sun's disc visible from each pixel: 1 lit. The positions in the unit disc are
// rotated by a different angle in each pixel. `suns`: the direction to the sun, one for all pixels
// or one for each.
BlockValues trace_sun(const Tracer& tracer, const BlockSurface& block,
                      std::span<const glm::dvec2> positions, std::span<const glm::dvec3> suns,
                      double sun_radius_rad);
// Share of each pixel's own directions that are free within reach; to be smoothed by
// mean_of_squares.
BlockValues trace_sky(const Tracer& tracer, const BlockSurface& block,
                      std::span<const SkyDirection> directions, double reach_m);
// Mean over 5 × 5 pixels with the outer ones at half weight, so that each of the 16 kinds of pixels
// has the same weight and the interleaved directions give a smooth value. Only pixels of the same
// surface (depths within 3 %) are averaged.
Grid<float> mean_of_squares(const Grid<float>& values, const Grid<float>& depth_m);

// Rays traced per pixel: quality against time.
struct SamplingParameters {
  int pixel_samples = 4;  // primary rays per pixel, 1, 4, 9 or 16
  int shadow_rays =
      8;  // towards the sun's disc, 1…64; blocks of pixels without penumbra use only two
  // Cosine-weighted directions shared by 2 × 2 pixels, 0 (sky view 1)…256: each pixel traces a
  // quarter of them, different for each of the 16 pixels of a 4 × 4 square, and the mean over such
  // a square is the pixel's sky view.
  int sky_directions = 16;
  double sky_reach_m = 12000.0;  // farther ground does not hide the sky, 1…1e6
};

}  // namespace belvedere
