#pragma once

#include <cstdint>

#include "texture/statistical/band_pyramid.h"

namespace belvedere {

// Light and shade of a crop come from relief and are not texture (Zalesny et al. 2005 call such
// crops composite): each half is learnt separately.
enum class LightHalf { lit, shaded };

// The states of a crop's pixels without those of the other half: pixels lighter, or darker, than
// the median of its lightness blurred over `blur_px` (sigma), which removes strokes and keeps the
// illumination. `states` (empty: all) selects the crop's pixels; others are ignored.
Grid<std::uint8_t> light_half(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                              LightHalf half, double blur_px = 6.0);

}  // namespace belvedere
