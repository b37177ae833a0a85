#pragma once

#include <cstdint>
#include <optional>

#include "texture/statistical/make_texture.h"

namespace belvedere {

// Synthesis of seams of any shape (Zalesny, Ferrari, Caenen, Van Gool, "Composite Texture
// Synthesis", 2005, section 6): the pixels along a border of two textures are synthesized by a
// model of both, in colours of the two. For pictures side by side statistical/texture_seam.h draws
// the border as well; here it is given, ragged, as left by copying.

// The look of one side of a seam: a picture, and where it shows that texture.
struct SeamSample {
  Grid<Rgb8> picture;
  Grid<std::uint8_t> counts;  // 0: not part of it
};
inline constexpr int seam_sample_px = 128;  // side of a sufficient sample

// A model of two adjoining textures; none if both together have too few pixels to learn from, or a
// single colour.
std::optional<CliqueModel> learn_seam(const SeamSample& one, const SeamSample& other);

// The pixels of a picture that belong to a seam.
struct SeamZone {
  Grid<std::uint8_t> side;  // 1 or 2: one texture or the other; 0: neither, ignored
  Grid<std::uint8_t> hole;  // not 0: to be synthesized; such pixels have a side
};
inline constexpr int seam_half_px = 3;  // synthesized on either side of a border

// The picture with its hole synthesized; nothing else changes. `position` as in fill_among.
Grid<Rgb8> synthesize_seam(const Grid<Rgb8>& picture, const SeamZone& zone,
                           TexturePosition position, const CliqueModel& model, std::uint64_t seed);

}  // namespace belvedere
