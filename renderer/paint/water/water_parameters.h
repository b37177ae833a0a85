#pragma once

#include <string>

namespace belvedere {

// How water is painted.
struct WaterParameters {
  // Where what it mirrors comes from: "traced", by the mirrored ray in the drawn world; "column", from the far shore in the same column
  // of the picture: quick, for drafts; "none".
  std::string mirror = "traced";
  double mirror_share = 1.0;  // how much stronger the image is than a painter's usual, 0…2
  double wind = 1.0;          // 0 smooth … 2: ruffled patches and streaks of light
  bool beds = true;           // lakes are seen through near their shores and deepen from turquoise to blue
  double surf_mm = 0.5;       // width of the broken line of surf along the sea's shores, mm of the sheet; 0 none, …3
  bool foam = true;           // white water where rivers fall
};

}  // namespace belvedere
