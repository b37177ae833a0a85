#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/paint/ground_hues.h"
#include "renderer/paint/palette.h"
#include "renderer/trace/wide_view.h"

namespace belvedere {

// How a forest stands, as a painter sees it: not an even cover but groups with gaps, glades that grass fills, lanes down the fall line,
// tracks that avalanches have swept from the treeline down, fuller gullies, and trees that thin out towards the treeline but stand like a
// wall where the forest ends on meadow. All sizes on the sheet, because trees keep their size whatever the distance.
struct ForestCoverParameters {
  double pixels_per_unit = 1.0;  // a unit is 0.5 mm of the sheet
  std::uint64_t seed = 1;
};

struct ForestCover {
  Grid<float> density;  // 0…1: share of the trees that are planted; 0 outside forest
  Grid<float> glade;    // 0…1: how far grass shows instead of wood; 0 outside forest
};

// Needs depths, places, classes, fall lines, slopes, footprints, small and middle relief and heights above the valley. Local up to
// forest_cover_margin_px(): a part with that margin equals the whole bit for bit. It is the wide view that must reach so far; of the
// buffers a pixel needs itself alone. Pixels outside `wanted` (empty: all) hold 0.
ForestCover make_forest_cover(const GuidanceBuffers& guidance, const WideView& wide, const ForestCoverParameters& parameters,
                              glm::ivec2 origin_px, PixelRect wanted = {});
int forest_cover_margin_px(double pixels_per_unit);

// Grass among trees: a little darker than that of the open. Encoded sRGB at a tone.
glm::vec3 glade_colour(const Palette& palette, double altitude_m, double light);

// Dwarf pines on alpine grass and bushes on shrubland, 0…1; `wood` is the share of forest around.
float bush_density(LandCoverClass id, float wood, const Patches& patches);

}  // namespace belvedere
