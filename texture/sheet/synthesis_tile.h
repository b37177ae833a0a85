#pragma once

#include <cstddef>

#include "base/progress.h"
#include "texture/sheet/synthesis_plan.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// The matches of one tile of the sheet's division. `guides` are those of synthesis_window(sheet,
// tile) (not read if the level is 0). The plan counts the texels that the tile uses during the call
// and is unchanged afterwards: one tile at a time. progress.advance sums to 1. Throws Error(usage)
// if the tile is not part of the division or guides are missing or of another size.
MatchField synthesize_tile(SynthesisPlan& plan, const GuideStack& guides, const PixelRect& tile,
                           Progress& progress);

}  // namespace belvedere
