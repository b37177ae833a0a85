#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "renderer/mist/mist_bodies.h"
#include "renderer/paint/picture_noise.h"
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

// The heaped surface of a sea of fog: rounded heaps with creases between, in the sizes that a
// painter uses, some 12 to 70 units of the sheet at every distance, and yet fixed to the ground:
// octaves of noise fade in and out with the metres per unit. Caches lattice values: use one per
// thread.
class MistBillows {
 public:
  // strength 0…3; highest_m: approximate upper limit of the heaps, > 0.
  MistBillows(std::uint64_t seed, double strength, double highest_m);
  // Height over the smooth surface, m, about 0 on average, within ± reach_m(). metres_per_unit: of
  // the ground in 0.5 mm of the sheet, > 0.
  double height_m(glm::dvec2 position, double metres_per_unit);
  // Bound of heaps and hollows, m.
  double reach_m() const { return reach_m_; }
  bool flat() const { return strength_ <= 0.0; }
  // Length of the dominant heaps, m.
  static double length_m(double metres_per_unit);

 private:
  double patches(glm::dvec2 position, double octave);

  double strength_;
  double highest_m_;
  double reach_m_;
  std::vector<GroundNoise> octaves_;
};

// Density of mist below its surface: 0 above, rising over `edge_m` to full density.
struct MistProfile {
  double full_per_m;  // extinction
  double edge_m;      // ≥ 0
};
// Extinction from `visibility_m`: a contrast of .02 remains (the visual range of Koschmieder 1924),
// so extinction is ln 50 / visibility_m.
MistProfile make_mist_profile(double visibility_m, double edge_m);
double extinction_at(const MistProfile& profile, double below_m);
// Optical depth of a straight path of length_m whose depth below the surface changes linearly from
// one end to the other: exact.
double optical_depth(const MistProfile& profile, double length_m, double below_from_m,
                     double below_to_m);

}  // namespace belvedere
