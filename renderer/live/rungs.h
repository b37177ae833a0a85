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
  bool strokes = true;  // rock relief, brushwork, mist, features and style; else light and colour
  // Draws the scene as it is; all others are on a level of the ground of about a million cells
  // (LivePicture::shortest_m says what that lacks), with one ray a pixel and few for the light of
  // the sky, and copy nothing from paintings.
  bool is_last() const { return without.empty(); }
};
const std::vector<Rung>& rungs();

// The scene as a rung draws it.
LoadedScene scene_of_rung(const LoadedScene& loaded, const Rung& rung);

}  // namespace belvedere
