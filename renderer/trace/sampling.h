#pragma once

namespace belvedere {

// How much is traced for each pixel: quality against time.
struct SamplingParameters {
  int pixel_samples = 4;  // primary rays a pixel, 1, 4, 9 or 16
  int shadow_rays = 8;    // towards the sun's disc, 1…64; blocks of pixels with no penumbra get by with two
  // Cosine-weighted directions that 2 × 2 pixels share, 0 (sky view 1)…256: each pixel traces a quarter of them, each of the 16
  // pixels of a 4 × 4 square others, and the mean over such a square is the pixel's sky view.
  int sky_directions = 16;
  double sky_reach_m = 12000.0;  // beyond that nothing hides the sky, 1…1e6
};

}  // namespace belvedere
