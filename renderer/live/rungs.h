#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene_file.h"
#include "renderer/world/coarse_ground_scene.h"

namespace belvedere {

// A live picture is made several times, each better and slower than the one before: a ladder, from
// what follows the hand to exactly what `render` makes at that size.
struct Rung {
  std::string name;
  std::vector<std::string> without;  // what the finished picture has and this one lacks, in words
  int max_width_px = 1000;           // of the picture, 64…4096
  double max_mcells = 0.0;           // millions of cells of the ground; 0: as the scene has it
  bool rock_relief = true;
  bool strokes = true;  // brushwork, mist, features and style; without them light and colour only
  bool quick_rays = false;  // one ray a pixel, few for the light of the sky
  bool copied = false;      // ground copied from paintings, if the scene asks for it
  bool is_last() const { return without.empty(); }
};
const std::vector<Rung>& rungs();

// The scene as a rung draws it.
LoadedScene scene_of_rung(const LoadedScene& loaded, const Rung& rung, const GroundSize& ground);

}  // namespace belvedere
