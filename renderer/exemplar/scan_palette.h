#pragma once

#include <utility>
#include <vector>

#include "renderer/exemplar/scan.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// `palette` with the paintings' colours: ramps of their classes, weighted by texels and with enough
// light to show relief; for missing classes those of a fallback class, or the palette's own,
// shifted by the mean difference of the known classes from it; sky, clouds and air from a painted
// sky. Without any painting, the palette unchanged.
Palette take_colours(const Palette& palette, const std::vector<ScannedPainting>& scans,
                     const std::vector<std::pair<LandCoverClass, LandCoverClass>>& fallback);

}  // namespace belvedere
