#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "renderer/compose/coarse_ground.h"

namespace belvedere {

// What a picture of a region can be about.
enum class AnchorKind : int {
  summit,  // the top of a massif
  canyon,  // the floor of a valley that is deep and narrow
  shore    // of a lake or the sea beneath mountains
};

struct Anchor {
  AnchorKind kind = AnchorKind::summit;
  glm::dvec2 place{0.0};
  double altitude_m = 0.0;
  double stands_m = 0.0;  // how high the summit stands above its valleys, how deep the canyon is cut, how high the land by the shore rises
  double rank = 0.0;      // 0…1: of its kind's best
  glm::dvec2 along{0.0};  // unit, upwards along the canyon; along the shore's water; 0, 0 of summits
};

struct Massifs {
  std::vector<Anchor> anchors;  // summits best first, then canyons, then shores
  double lone = 0.0;            // 0…1: one mountain stands alone, as volcanoes do, rather than a chain
  // A summit that would be the first one, but lies too near to where the data end; else empty.
  std::vector<Anchor> at_the_rim;

  const Anchor& main() const { return anchors.front(); }
};

// In words: "a canyon cut 420 m deep".
std::string describe_anchor(const Anchor& anchor);

// Summits: the highest within .02 of the side, .05 of it off the rim, .14 of it from better ones, four at most; ranked by how high they
// stand in the whole times over their valleys, and by the mass of ground that stands high around them. Canyons, two at most: where the
// ground with narrow valleys filled lies highest above them. Shores, two at most: where the land rises highest beside level water.
Massifs find_massifs(const CoarseGround& ground);

}  // namespace belvedere
