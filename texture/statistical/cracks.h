#pragma once

#include <vector>

#include "base/progress.h"
#include "texture/statistical/learn_texture.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Cracks and pits of a weathered texture (Zalesny et al. 2005, section 7): the crop's darkest
// pixels are a texture of their own, which is learnt and made without the rest. Thresholds of the
// ridges of what is made, whose pieces are joined until they are as long as in the crop, then give
// a series of masks, from the deepest cracks to all of them.
struct CrackModel {
  CliqueModel depth;          // grey: 0 intact … 255 within a crack
  Rgb8 colour{};              // of the crop's cracks, their mean
  double share = 0.0;         // of the crop's pixels
  double pieces = 0.0;        // connected ones (also by corners) per pixel of the crop's cracks
  Grid<std::uint8_t> intact;  // the states of the crop's pixels without its cracks and their rims,
                              // to learn the intact texture from
};

// `darkest`: share of the crop's pixels that are cracks, 0…0.5. Errors as learn_texture.
CrackModel learn_cracks(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states, double darkest,
                        const LearnParameters& parameters, Progress& progress = silent_progress());

// A picture with `steps` increasing shares of cracks, the last as many as in the crop. Cracks only
// grow from one to the next, and pixels without any stay to the bit.
std::vector<Grid<Rgb8>> lay_cracks(const Grid<Rgb8>& picture, const CrackModel& cracks, int steps,
                                   std::uint64_t seed, Progress& progress = silent_progress());

}  // namespace belvedere
