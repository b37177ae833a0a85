#pragma once

#include <glm/vec2.hpp>

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

struct GeneralizedTerrain {
  Grid<float> altitude_m;
  Grid<glm::vec2> came_from;  // WidenedValleys::came_from; empty where no ground moved
  Grid<glm::vec2> goes_to;    // WidenedValleys::goes_to
};

// A DEM generalized as the scene asks for one view: by the distance from the viewer, by what its print can show, and by masks. `land_cover`
// is looked at where the scene masks by class; null: it is made then. Its cells are the DEM's. The cache keeps it: of the view it depends
// on the viewer's place, and on the camera only where the print's detail is asked for. `sea`: of a window of a larger DEM, its own.
GeneralizedTerrain generalize_for_view(const LoadedScene& loaded, const Dem& dem, const LandCover* land_cover, const View& view,
                                       Progress& progress, const Cache& cache = no_cache(), const SeaParameters* sea = nullptr);

// Pixels that a metre of ground at `place` takes at most, from differences over ±step_m; 0 behind the eye.
double pixels_per_m(const Camera& camera, const Deformation& deformation, glm::dvec2 place, double altitude_m, double step_m);

// Ground metres that an output pixel shows, at every 16th cell of the DEM, in the direction in which the picture shows most: what is
// finer cannot be seen however the ground lies. Behind the eye it goes on as the distance does. Empty where no ground is before it.
PixelGround ground_m_per_pixel(const Dem& dem, const View& view);

}  // namespace belvedere
