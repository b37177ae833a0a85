#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "renderer/mist/mist_bed.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/trace/camera.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// A cloud attached to a summit and drawn out by the wind: puffs in the deformed world, so that
// terrain is in front of and behind it.
struct LeePuff {
  glm::dvec3 centre;
  double radius_m;  // horizontal; its height is .7 of it
  float opacity;    // 0…1
};
struct LeeCloud {
  std::vector<LeePuff> puffs;  // far to near
  double altitude_m = 0.0;     // of its summit, undeformed
  glm::dvec2 from_px{0.0};     // bounding box in the picture
  glm::dvec2 to_px{0.0};
  double length_px = 1.0;  // length of the cloud if perpendicular to the view
  std::uint64_t seed = 1;
};
// Nothing if the summit is behind the eye. ground_m: the summit's altitude.
std::optional<LeeCloud> make_lee_cloud(const MistParameters& parameters, double ground_m,
                                       const Deformation& deformation, const Camera& camera,
                                       std::uint64_t seed);

// The ragged edges of its puffs; use one per thread.
class LeeEdges {
 public:
  explicit LeeEdges(const LeeCloud& cloud);
  // Shares of a puff's radius, at a position of the picture.
  glm::vec2 at(glm::dvec2 pixel);

 private:
  double per_px_;
  std::array<GroundNoise, 4> noises_;
};

// The cloud along one line of sight that ends after depth_m (infinite: sky).
struct LeeSight {
  float share = 0.F;  // share of the background that it hides, 0…1
  float light = 0.F;  // 0…1
  double depth_m = 0.0;
};
// towards_sun: unit.
LeeSight see_lee_cloud(const LeeCloud& cloud, LeeEdges& edges, const Ray& ray, glm::dvec2 pixel,
                       double depth_m, glm::dvec3 towards_sun);

}  // namespace belvedere
