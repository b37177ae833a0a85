#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>

#include "base/run.h"
#include "renderer/scene/scene_file.h"

namespace belvedere::tools {

// An area whose maps are to be fetched.
struct WantedPlace {
  glm::dvec2 at_lonlat{0.0};  // its centre, °
  glm::dvec2 size_km{60.0};   // west to east, south to north
  bool land_cover = true;
  std::string folder;  // for the maps, below the scene's
};
// Fetches the maps of a place, and returns the text of a scene of them, as `new` proposes it.
using OpenPlace = std::function<std::string(const WantedPlace& place, const Run& run)>;

struct StudioParameters {
  std::string scene;  // path
  SceneFileOptions files;
  int port = 0;               // 0: any that is free
  OpenPlace open_place = {};  // nothing: places are refused
};

}  // namespace belvedere::tools
