#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

#include "renderer/paint/air.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// The sky of the base picture: a gradient from the palette, thin veils, and clouds over level
// bases, smaller towards the horizon. No two clouds are the same, and every seed has its own sky.
// Sizes follow the height of the sky, so all resolutions look the same.
struct SkyParameters {
  glm::ivec2 picture_size{CameraParameters{}.width,
                          CameraParameters{}.height};  // px, the whole picture
  double horizon_px = 198.0;  // row of the horizon in the whole picture, > 0; see skyline_row_px
  double clouds = AirParameters{}.clouds;  // amount, 0 (none)…2
  SkyKind kind = AirParameters{}.sky;
  double sun_image_x = 1.0;  // > 0: the right sides of clouds are lit, -1…1
  bool winter = false;       // heaps are lower and fewer
  std::uint64_t seed = 1;
};

// Properties that the clouds of a sky share, drawn once from its seed.
struct SkyLook {
  SkyKind kind = SkyKind::fair;  // never `any`
  double amount = 1.0;           // factor on the number of clouds
  double size = 1.0;             // factor on their size
  double raised = 1.0;           // factor on their height above the horizon
  double heaped = 0.5;           // 0 drawn out by wind … 1 heaps
  double veils = 1.0;            // factor on the density of veils and streaks
  glm::dvec2 vanishing_px{0.0};  // apparent origin of rows and streaks, below the horizon:
                                 // rows within the picture, streaks beside it
};
// Finds a kind by its enumerator's name; Error(input) otherwise.
SkyKind find_sky_kind(std::string_view name);
SkyLook look_of_sky(const SkyParameters& parameters);
// Unit of cloud sizes: the height of the sky, limited in narrow pictures.
double cloud_scale_px(const SkyParameters& parameters);

// A rounded head of a cloud; a cloud is a heap of them over a level base. In pixels of the whole
// picture.
struct CloudHead {
  glm::vec2 centre;
  glm::vec2 radius;
};
struct Cloud {
  float base_px;       // row of the level base
  glm::vec2 from, to;  // bounding box
  float opacity;       // 0…1
  int grain;           // fineness of its edges: 0 near … 3 far, each half the one before
  std::vector<CloudHead> heads;  // far to near
  float underlit = 0.0F;         // 0 lit from above … 1 lit from below by a low sun
};
// All clouds of a picture, far to near: a pure function of the parameters.
std::vector<Cloud> make_clouds(const SkyParameters& parameters);

}  // namespace belvedere
