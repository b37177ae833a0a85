#pragma once

#include <algorithm>
#include <cstdint>

#include "base/progress.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

struct SeamParameters {
  int band_px =
      0;  // on either side of the seam that may change, 8…256; 0: chosen by the step, 24 or more
  int types = 28;  // of the models learnt for it
  std::uint64_t seed = 1;
};

// Joins two pictures side by side (Zalesny, Ferrari, Caenen, Van Gool, "Composite Texture
// Synthesis", 2005, section 6). Each is grown over the seam by a model of its own, a ragged border
// is drawn where one ends and the other begins, and the pixels along that border are synthesized by
// a model of both, in colours of the two. No pixel farther than the band from the seam changes.
// Pictures whose seam is not more visible than unseen_seam are left unchanged, because any change
// could only add noise. Error(usage) for different heights, Error(input) as in learn_texture for
// pictures under 48 pixels on a side.
struct SeamInput {
  Grid<Rgb8> picture;
  int band_px = 0;      // used; 0: left unchanged
  double before = 0.0;  // seam_ratio of the two side by side,
  double after = 0.0;   // and joined
};
SeamInput synthesize_texture_seam(const Grid<Rgb8>& left, const Grid<Rgb8>& right,
                                  const SeamParameters& parameters,
                                  Progress& progress = silent_progress());
inline constexpr double unseen_seam = 1.25;

// Side by side without changes; of one height.
template <class Pixel>
Grid<Pixel> side_by_side(const Grid<Pixel>& left, const Grid<Pixel>& right) {
  Grid<Pixel> out(left.width() + right.width(), left.height());
  for (int y = 0; y < out.height(); ++y) {
    std::copy_n(left.row(y), left.width(), out.row(y));
    std::copy_n(right.row(y), right.width(), out.row(y) + left.width());
  }
  return out;
}

// Visibility of a vertical line in a picture: the mean step of colour from column x - 1 to x,
// relative to the mean of such steps in `within` columns on both sides of it, except the nearest
// `apart`. 1: like any other.
double seam_ratio(const Grid<Rgb8>& picture, int x, int apart, int within = 48);

}  // namespace belvedere
