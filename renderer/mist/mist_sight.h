#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "renderer/mist/lee_cloud.h"
#include "renderer/mist/mist_bed.h"
#include "renderer/mist/mist_parameters.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// All the mist of a picture, made once.
struct MistAir {
  std::vector<MistParameters> layers;  // seas and valleys
  std::vector<LeeCloud> clouds;
  MistGround ground;
  double rim_fade_m = 0.0;  // distance over which layers thin out towards the end of the terrain
  double farthest_m = 0.0;  // from the eye: end of lines of sight without ground
  std::uint64_t seed = 1;

  bool empty() const { return layers.empty() && clouds.empty(); }
};

// The view and its light.
struct MistView {
  const Camera& camera;
  const Deformation& deformation;
  const Tracer* tracer = nullptr;           // for cast shadows; null: none
  glm::dvec3 sun_direction{0.0, 0.0, 1.0};  // unit
  double pixels_per_unit = 1.0;
};

// Mist per pixel. All grids have the requested size.
struct MistSight {
  Grid<float> share;       // share of the background that it hides, 0…1
  Grid<float> depth_m;     // mean distance of the hiding mist; +inf where there is none
  Grid<float> light;       // 0 deep shade … 1 lit heaps
  Grid<float> altitude_m;  // true
};

// Integrates mist along the line of sight through the centre of every pixel, from the eye to the
// ground in the pixel (depth_m, +inf for sky). Lengths along the line are those of the drawn scene;
// density depends on the undeformed position and altitude there (undeform), so that a sea of fog
// meets every slope at its altitude however the ground is bent. Pixels are independent of each
// other.
MistSight see_mist(const MistAir& air, const MistView& view, const Grid<float>& depth_m,
                   glm::ivec2 origin_px);

}  // namespace belvedere
