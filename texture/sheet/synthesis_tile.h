#pragma once

#include <cstddef>

#include "base/progress.h"
#include "texture/sheet/synthesis_plan.h"
#include "texture/synthesis/guide_stack.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// The matches of one tile of the sheet's division. `guides` are those of synthesis_window(sheet, tile) (of which nothing is read where the
// level is 0). The plan counts along which texels the tile uses, and is as before when the call ends: one tile at a time.
// progress.advance comes to 1 in all. Throws Error(usage) where the tile is none of the division or guides are missing or of another size.
MatchField synthesize_tile(SynthesisPlan& plan, const GuideStack& guides, const PixelRect& tile, Progress& progress);

}  // namespace belvedere
