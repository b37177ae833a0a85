#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

#include "renderer/paint/air_parameters.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// The sky of the base picture: a gradient from the palette, thin veils, and clouds over level bases, which shrink towards the horizon. No
// two clouds are alike, and every seed has a sky of its own. Sizes follow the height of the sky, so all resolutions look alike.
struct SkyParameters {
  glm::ivec2 picture_size{CameraParameters{}.width, CameraParameters{}.height};  // px, the whole picture
  double horizon_px = 198.0;               // row of the horizon in the whole picture, > 0; see skyline_row_px
  double clouds = AirParameters{}.clouds;  // how many, 0 (none)…2
  SkyKind kind = AirParameters{}.sky;
  double sun_image_x = 1.0;  // > 0: the right sides of clouds are lit, -1…1
  bool winter = false;       // heaps are lower and fewer
  std::uint64_t seed = 1;
};

// What a sky's clouds have in common, drawn once from its seed.
struct SkyLook {
  SkyKind kind = SkyKind::fair;  // never any
  double amount = 1.0;           // on how many there are
  double size = 1.0;             // on how large they are
  double raised = 1.0;           // on how high they stand
  double heaped = 0.5;           // 0 drawn out by the wind … 1 heaps
  double veils = 1.0;            // on how dense veils and streaks are
  glm::dvec2 vanishing_px{0.0};  // where rows and streaks seem to come from, below the horizon: rows within the picture, streaks beside it
};
// Of a name: those of the enumerators. Error(input) for another.
SkyKind find_sky_kind(std::string_view name);
SkyLook look_of_sky(const SkyParameters& parameters);
// What clouds are measured in: the height of the sky, but no more than a narrow picture can carry.
double cloud_scale_px(const SkyParameters& parameters);

// A rounded head of a cloud; a cloud is a heap of them over a level base. In pixels of the whole picture.
struct CloudHead {
  glm::vec2 centre;
  glm::vec2 radius;
};
struct Cloud {
  float base_px;                 // row of the level base
  glm::vec2 from, to;            // box that holds all of it
  float opacity;                 // 0…1
  int grain;                     // how fine its edges are: 0 near … 3 far, each half the one before
  std::vector<CloudHead> heads;  // far to near
  float underlit = 0.0F;         // 0 lit from above … 1 by a low sun from below
};
// All clouds of a picture, far to near: a pure function of the parameters.
std::vector<Cloud> make_clouds(const SkyParameters& parameters);

}  // namespace belvedere
