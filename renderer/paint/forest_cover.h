#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/palette.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// The structure of a forest as a painter shows it: groups with gaps instead of an even cover,
// grassy glades, lanes down the fall line, avalanche tracks from the treeline down, denser gullies,
// and trees that thin out towards the treeline but form a wall where the forest ends at a meadow.
// All sizes are on the sheet, because painted trees keep their size at any distance.
struct ForestCoverParameters {
  double pixels_per_unit = 1.0;  // a unit is 0.5 mm of the sheet
  std::uint64_t seed = 1;
};

struct ForestCover {
  Grid<float> density;  // 0…1: share of the trees that are placed; 0 outside forest
  Grid<float> glade;    // 0…1: share of grass instead of trees; 0 outside forest
};

// Needs depths, positions, classes, fall lines, slopes, footprints, small and middle relief and
// heights above the valley. Local up to forest_cover_margin_px(): a part with that margin equals
// the whole bit for bit. Only the wide view must reach so far; from the buffers a pixel reads only
// itself. Pixels outside `wanted` (empty: all) hold 0.
ForestCover make_forest_cover(const GuidanceBuffers& guidance, const WideView& wide,
                              const ForestCoverParameters& parameters, glm::ivec2 origin_px,
                              PixelRect wanted = {});
int forest_cover_margin_px(double pixels_per_unit);

// Grass among trees: slightly darker than open grass. Encoded sRGB at a tone.
glm::vec3 glade_colour(const Palette& palette, double altitude_m, double light);

// Dwarf pines on alpine grass and bushes on shrubland, 0…1; `wood` is the share of forest around.
float bush_density(LandCoverClass id, float wood, const Patches& patches);

}  // namespace belvedere
