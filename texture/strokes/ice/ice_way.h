#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "base/land_cover_class.h"
#include "base/random.h"

namespace belvedere {

// A series of strokes on ice longer than a stroke's reach: a line that runs down with the ice, a
// series of crevasses.
struct IceWay {
  Stream stream;                       // of the kind of its strokes
  glm::ivec2 cell{0};                  // cell of its seed: all its random numbers derive from it
  LandCoverClass land_cover;           // class that it runs over
  float strength = 0.F;                // of crevasses: how broken the ice is, 0…1
  float size_units = 0.F;              // of crevasses: length of the longest
  bool is_icefall = false;             // of crevasses: broken into blocks
  std::vector<glm::vec2> positions{};  // units of the sheet, downwards, never empty
  std::vector<float> depth_m{};        // of the ground at each position
  std::vector<glm::vec2> across{};  // what a unit of level ground across the flow measures on the
                                    // sheet at each position, units; empty for flow lines
  std::vector<float> half_width{};  // of moraines at each position, units of ground
  glm::vec2 lowest{0.F}, highest{0.F};  // min and max of the positions' coordinates
};

}  // namespace belvedere
