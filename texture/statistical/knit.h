#pragma once

#include <algorithm>
#include <cstdint>

#include "base/progress.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

struct KnitParameters {
  int band_px = 0;  // on either side of the seam that may change, 8…256; 0: as the step asks, 24 and more
  int types = 28;   // of the models that are learnt for it
  std::uint64_t seed = 1;
};

// Two pictures side by side, joined (Zalesny, Ferrari, Caenen, Van Gool, "Composite Texture Synthesis", 2005, section 6: texture knitting).
// Each is grown over the seam by a model of its own, a ragged border is drawn where one ends and the other begins, and the pixels along
// that border are made anew by a model of both, in colours that the two have. No pixel farther than the band from the seam changes.
// Pictures whose seam is no plainer than unseen_seam are left as they are: what is made could only be busier.
// Error(usage) for other heights, Error(input) as of learn_texture for pictures under 48 pixels a side.
struct KnitPicture {
  Grid<Rgb8> picture;
  int band_px = 0;      // that was taken; 0: left as it was
  double before = 0.0;  // seam_ratio of the two put side by side,
  double after = 0.0;   // and knitted
};
KnitPicture knit_textures(const Grid<Rgb8>& left, const Grid<Rgb8>& right, const KnitParameters& parameters,
                          Progress& progress = silent_progress());
inline constexpr double unseen_seam = 1.25;

// Beside each other without more ado; of one height.
template <class Pixel>
Grid<Pixel> side_by_side(const Grid<Pixel>& left, const Grid<Pixel>& right) {
  Grid<Pixel> out(left.width() + right.width(), left.height());
  for (int y = 0; y < out.height(); ++y) {
    std::copy_n(left.row(y), left.width(), out.row(y));
    std::copy_n(right.row(y), right.width(), out.row(y) + left.width());
  }
  return out;
}

// How plain a line of a picture is to see: the mean step of colour from column x - 1 to x, over the mean of such steps in `within` columns
// on both sides of it, the nearest `apart` left out. 1: as any other.
double seam_ratio(const Grid<Rgb8>& picture, int x, int apart, int within = 48);

}  // namespace belvedere
