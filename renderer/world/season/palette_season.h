#pragma once

#include <functional>

#include "renderer/paint/palette.h"

namespace belvedere {

// A palette with its ramps moved up by this height (down if < 0): its altitudes are those of the
// northern Alps, whose forest ends at palette_treeline_m.
Palette palette_at_other_altitudes(Palette palette, double higher_m);

// Blends two palettes by altitude: `share` is that of the second, 0…1, at an altitude in m. Ramps
// are blended every 50 m where it changes; colours without altitude (sky, air, leaves) take the
// mean of the shares at `lowest_m` and `highest_m`, the range of the picture. Winter is the
// first's.
Palette mix_palettes(const Palette& first, const Palette& second,
                     const std::function<double(double altitude_m)>& share, double lowest_m,
                     double highest_m);

}  // namespace belvedere
