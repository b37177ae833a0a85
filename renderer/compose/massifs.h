#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "renderer/compose/coarse_ground.h"

namespace belvedere {

// A possible subject of a picture of a region.
enum class AnchorKind : int {
  summit,  // the top of a massif
  canyon,  // the floor of a valley that is deep and narrow
  shore    // of a lake or the sea below mountains
};

struct Anchor {
  AnchorKind kind = AnchorKind::summit;
  glm::dvec2 position{0.0};
  double altitude_m = 0.0;
  double stands_m = 0.0;  // height of the summit above its valleys, depth of the canyon, or height
                          // of the land by the shore
  double rank = 0.0;      // 0…1: relative to the best of its kind
  glm::dvec2 along{
      0.0};  // unit, upwards along the canyon; along the shore's water; 0, 0 of summits
};

struct Massifs {
  std::vector<Anchor> anchors;  // summits best first, then canyons, then shores
  double lone = 0.0;  // 0…1: one mountain stands alone, like a volcano, rather than a chain
  // A summit that would rank first but lies too near the end of the data; else empty.
  std::vector<Anchor> at_the_rim;

  const Anchor& main() const { return anchors.front(); }
};

// A description: "a canyon cut 420 m deep".
std::string describe_anchor(const Anchor& anchor);

// Summits: the highest within .02 of the side, .05 of it off the rim, .14 of it from better ones,
// four at most; ranked by their total height times that above their valleys, and by the mass of
// high ground around them. Canyons, two at most: where the ground with narrow valleys filled lies
// highest above them. Shores, two at most: where the land rises highest beside level water.
Massifs find_massifs(const CoarseGround& ground);

}  // namespace belvedere
