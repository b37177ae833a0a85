#pragma once

#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"
#include "renderer/exemplar/scan.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// `palette` with the paintings' colours: ramps of their classes, weighted by texels and with enough
// light to show relief; for missing classes those of a fallback class, or the palette's own,
// shifted by the mean difference of the known classes from it; sky, clouds and air from a painted
// sky. Without any painting, the palette unchanged.
Palette take_colours(const Palette& palette, const std::vector<ScannedPainting>& scans,
                     const std::vector<std::pair<LandCoverClass, LandCoverClass>>& fallback);

// How far the paintings' water is from the palette's, encoded sRGB, the mean over tones: that of
// their own water if they have any, else that of the ground around rivers (valley floor, pasture,
// forest), else of all their classes. 0 without paintings.
glm::vec3 water_shift(const Palette& palette, const std::vector<ScannedPainting>& scans);

}  // namespace belvedere
