#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/world/view.h"
#include "terrain/cover/land_cover.h"
#include "terrain/deform/deform.h"
#include "terrain/generalize/generalize.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// Masks of generalization, from the cells of the data.
struct GroundMasks {
  Grid<float> mask;                  // by slope, and drawn: GeneralizeGrids::mask
  Grid<float> amplify;               // GeneralizeGrids::amplification_mask
  Grid<std::uint8_t> keep;           // GeneralizeGrids::keep
  Grid<std::uint8_t> unchanged;      // GeneralizeGrids::unchanged, of previews
  Grid<float> along_lines_m;         // smoothed along slope lines; generalized instead of the DEM
  std::vector<Grid<float>> finer_m;  // GeneralizeGrids::finer_m, of previews
};                                   // each is empty where the scene has none
// The masks of a preview: made from the data, because their openings and dilations count cells, and
// then reduced to the level of the preview. `areas`: of the map, may be null.
GroundMasks preview_masks(const LoadedScene& loaded, const Dem& data, int level,
                          const MapCover* areas, Progress& progress);

// Inputs that generalize_for_view otherwise finds itself (null).
struct GroundGiven {
  const SeaParameters* sea = nullptr;  // of a window of a larger DEM, its own
  const GroundMasks* masks = nullptr;  // of a preview
  const MapCover* areas = nullptr;     // of the map, whose lakes keep their level, without cover
};

struct GeneralizedTerrain {
  Grid<float> altitude_m;
  Grid<glm::vec2> came_from;  // WidenedValleys::came_from; empty where no ground moved
  Grid<glm::vec2> goes_to;    // WidenedValleys::goes_to
};

// Generalizes a DEM as the scene requests for one view: by the distance from the viewer, by the
// print's detail, and by masks. `land_cover` is used if the scene masks by class; null: it is then
// made. Its cells are the DEM's. The result is cached: of the view it depends on the viewer's
// position, and on the camera only if the print's detail is limited.
GeneralizedTerrain generalize_for_view(const LoadedScene& loaded, const Dem& dem,
                                       const LandCover* land_cover, const View& view,
                                       Progress& progress, const Cache& cache = no_cache(),
                                       const GroundGiven& given = {});

// Resolution of the picture at `position`: maximum pixels per metre of ground, from differences
// over ±step_m; 0 behind the viewer.
double pixels_per_m(const Camera& camera, const Deformation& deformation, glm::dvec2 position,
                    double altitude_m, double step_m);

// Ground metres per output pixel, at every 16th cell of the DEM, in the direction of highest
// resolution: finer detail is invisible whatever the slope and direction of the ground. Behind the
// viewer it is extrapolated by distance. Empty where no ground is in front.
PixelGround ground_m_per_pixel(const Dem& dem, const View& view);

}  // namespace belvedere
