#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "base/run.h"
#include "renderer/exemplar/light/painting_light.h"
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

// The traced guidance of a registered painting, of that size: all channels but tone, base picture
// and paint. `scene` is registered_scene() with its terrain; `dem` is that terrain.
GuidanceBuffers trace_registered_guidance(const LoadedScene& scene, std::shared_ptr<const Dem> dem,
                                          glm::ivec2 size_px, const Run& run);

// A part of a painting with its own light.
struct RegisteredRegion {
  SunEstimate sun;
  double bearing_deg = 0.0;         // of its middle from the eye, clockwise from north
  std::vector<glm::dvec2> outline;  // of the ground that it shows: convex, scene CRS; empty: sky
};

// The light of a registered painting.
struct RegisteredLight {
  SunEstimate sun;                 // of the whole
  double bearing_deg = 0.0;        // of the picture's middle from the eye
  Grid<RegisteredRegion> regions;  // of the picture, by columns and rows
};

// The sun of a painting (find_painting_light) as large as its guidance, and of its regions; `eye`
// is the viewer's position.
RegisteredLight find_registered_light(const Grid<glm::vec3>& painting,
                                      const GuidanceBuffers& guidance, glm::dvec2 eye);

// Regions whose paint tells of another sun than that of the whole (SunEstimate::differs), by more
// than 25° of azimuth.
std::vector<RegisteredRegion> regions_of_other_light(const RegisteredLight& light);

// The scene's sun, if the paint tells, and regions of light for those regions.
void light_scene(const RegisteredLight& light, Scene& scene);

}  // namespace belvedere
