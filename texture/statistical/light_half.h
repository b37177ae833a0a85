#pragma once

#include <cstdint>

#include "texture/statistical/band_pyramid.h"

namespace belvedere {

// Light and shade of a crop are relief and no texture (Zalesny et al. 2005 call such crops composite): each half is learnt by itself.
enum class LightHalf { lit, shaded };

// The states of a crop's pixels with those of the other half taken out: what is lighter, or darker, than the median of its lightness
// blurred over `blur_px` (sigma), which leaves strokes and keeps what the light falls on. `states` (empty: all) counts the crop's pixels;
// what does not count is looked at by nobody.
Grid<std::uint8_t> light_half(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states, LightHalf half, double blur_px = 6.0);

}  // namespace belvedere
