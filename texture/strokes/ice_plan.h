#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/random_streams.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/ice_flow.h"

namespace belvedere {

// A series of strokes on ice longer than a stroke's reach: a line that runs down with the ice, a
// series of crevasses.
struct IceWay {
  Stream stream;                        // of the kind of its strokes
  glm::ivec2 cell{0};                   // cell of its seed: all its random numbers derive from it
  LandCoverClass land_cover;            // class that it runs over
  float strength = 0.F;                 // of crevasses: how broken the ice is, 0…1
  float size_units = 0.F;               // of crevasses: length of the longest
  std::vector<glm::vec2> positions{};   // units of the sheet, downwards, never empty
  std::vector<float> depth_m{};         // of the ground at each position
  glm::vec2 lowest{0.F}, highest{0.F};  // min and max of the positions' coordinates
};

// The ice on a whole sheet, which no window of it can determine. In units of the sheet, so that one
// plan serves every size.
struct IcePlan {
  IceFlow flow;
  std::vector<IceWay> ways;
};

// From a picture of the whole sheet; about one pixel per unit is sufficient. Needs depth, land
// cover, fall line, slope and relief_s. It uses the parameters pixels_per_unit (of this picture)
// and seed.
IcePlan plan_ice(const GuidanceBuffers& guidance, const StrokeParameters& parameters);

}  // namespace belvedere
