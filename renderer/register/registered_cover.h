#pragma once

#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "renderer/register/painter_lines.h"
#include "renderer/scene/scene_file.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The land cover of a registered painting.
struct RegisteredCover {
  PainterLines lines;    // of the painter
  PainterLines climate;  // of the place, at the middle of the map; 0: not known
};

// The lines of a painting as large as its guidance, whose classes follow the scene's rules on its
// terrain. sigma_px: how far places may be off, of the same size; only ground that is known to a
// hundredth of the width counts.
RegisteredCover find_registered_cover(const Grid<glm::vec3>& painting, const Grid<float>& sigma_px,
                                      const GuidanceBuffers& guidance, const LoadedScene& scene,
                                      const Dem& dem, Progress& progress);

// The lines as settings of the scene's class rules; those that the paint does not tell are left
// out.
void cover_scene(const RegisteredCover& cover, Scene& scene);

// The land cover of the guidance again, as the scene has it on its terrain.
void renew_land_cover(const LoadedScene& scene, const Dem& dem, GuidanceBuffers& guidance,
                      Progress& progress);

}  // namespace belvedere
