#pragma once

#include <functional>

#include "renderer/paint/palette.h"

namespace belvedere {

// A palette whose ramps hold so much higher up (lower, < 0): its altitudes are those of the northern Alps, whose forest ends at
// palette_treeline_m.
Palette palette_at_other_altitudes(Palette palette, double higher_m);

// Between two palettes, by altitude: `share` is that of the second, 0…1, at an altitude in m. Ramps are mixed every 50 m where it changes;
// what has no altitude (sky, air, leaves) takes the mean of the shares at `lowest_m` and `highest_m`, between which the picture lies.
// Winter is the first's.
Palette mix_palettes(const Palette& first, const Palette& second, const std::function<double(double altitude_m)>& share, double lowest_m,
                     double highest_m);

}  // namespace belvedere
