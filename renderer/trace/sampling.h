#pragma once

namespace belvedere {

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
