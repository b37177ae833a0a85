#pragma once

#include <cstdint>
#include <optional>

#include "texture/statistical/make_texture.h"

namespace belvedere {

// Seams of any shape, knitted (Zalesny, Ferrari, Caenen, Van Gool, "Composite Texture Synthesis", 2005, section 6): the pixels along a
// border of two textures are made anew by a model of both, in colours that the two have. For pictures side by side there is
// statistical/knit.h, which draws the border as well; here it is there, ragged, as copying has left it.

// What one side of a seam looks like: a picture, and where it is that texture.
struct SeamSample {
  Grid<Rgb8> picture;
  Grid<std::uint8_t> counts;  // 0: no part of it
};
inline constexpr int seam_sample_px = 128;  // a side of a sample that is enough

// A model of two textures that meet; none where both together show less than can be learnt from, or one colour.
std::optional<CliqueModel> learn_seam(const SeamSample& one, const SeamSample& other);

// Of a picture, what belongs to a seam.
struct SeamZone {
  Grid<std::uint8_t> side;  // 1 or 2: of one texture or the other; 0: of neither, not looked at
  Grid<std::uint8_t> hole;  // not 0: to be made anew; such pixels have a side
};
inline constexpr int seam_half_px = 3;  // on either side of a border that is made anew

// The picture with its hole made anew; nothing else changes. `place` as in fill_among.
Grid<Rgb8> knit_seam(const Grid<Rgb8>& picture, const SeamZone& zone, TexturePlace place, const CliqueModel& model, std::uint64_t seed);

}  // namespace belvedere
