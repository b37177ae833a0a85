#pragma once

#include <string>

namespace belvedere {

struct WaterParameters {
  // Source of reflections: "traced", the mirrored ray in the drawn terrain; "column", the far shore
  // in the same column of the picture: fast, for drafts; "none".
  std::string mirror = "traced";
  double mirror_share = 1.0;  // factor on the usual strength of the reflection, 0…2
  double wind = 1.0;          // 0 smooth … 2 ruffled patches and streaks of light
  bool beds = true;  // lake beds show near the shores; water deepens from turquoise to blue
  double surf_mm =
      0.5;  // width of the broken line of surf along the sea's shores, mm of the sheet; 0 none, …3
  bool foam = true;  // white water where rivers are steep
};

}  // namespace belvedere
