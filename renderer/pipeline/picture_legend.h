#pragma once

#include <vector>

#include "renderer/labels/margin.h"
#include "renderer/paint/palette.h"
#include "renderer/world/world.h"

namespace belvedere {

// The classes that a picture shows, in the order of their table: what covers a thousandth of its ground or more, in the colour that the
// palette gives it in good light at the mean altitude at which it grows on this terrain. Looks at a small picture of the whole sheet.
std::vector<LegendEntry> find_legend(const World& world, const Palette& palette);

}  // namespace belvedere
