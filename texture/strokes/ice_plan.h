#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/random_streams.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/ice_flow.h"

namespace belvedere {

// Where strokes of ice follow each other farther than a stroke reaches: a line that runs down with the ice, a flight of crevasses.
struct IceWay {
  Stream stream;                        // of the kind whose strokes lie along it
  glm::ivec2 cell{0};                   // that its seed stands in: whatever is drawn by lot for it is drawn from this
  LandCoverClass land_cover;            // what it runs over
  float strength = 0.F;                 // of crevasses: how torn the ice is, 0…1
  float size_units = 0.F;               // of crevasses: length of the longest
  std::vector<glm::vec2> places{};      // units of the sheet, downwards, never empty
  std::vector<float> depth_m{};         // of the ground at each place
  glm::vec2 lowest{0.F}, highest{0.F};  // least and greatest of the places' coordinates
};

// How ice runs on a sheet: what no window of it can tell. In units of the sheet, so that one plan serves every size.
struct IcePlan {
  IceFlow flow;
  std::vector<IceWay> ways;
};

// From a picture of the whole sheet; one of about a pixel a unit shows all that is asked. Needs depth, land cover, fall line, slope and
// relief_s. Of the parameters it takes pixels_per_unit (of this picture) and seed.
IcePlan plan_ice(const GuidanceBuffers& guidance, const StrokeParameters& parameters);

}  // namespace belvedere
