#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "tools/cli/scene_options.h"

namespace belvedere::tools {

class CommandOptions;

// Command-line options of `deform`.
struct DeformOptions {
  SceneOptions scene;  // its `scene` is a scene file or a DEM
  std::string dem_out;
  std::string viewer;
  std::string exaggeration;
  std::string bend;
  std::vector<std::string> handles;
  std::vector<std::string> locate;
  std::vector<std::string> at;
  bool search_bend = false;
  double max_distortion_deg = 20.0;
  double max_bending_deg = 6.0;
  int points = 5;
  std::string out;  // of --search-bend a picture, of --locate FILE a table
};
void add_deform_options(CommandOptions& command, DeformOptions& options);

// "692000,5302000" to a pair. Throws Error(usage) naming the option.
glm::dvec2 parse_pair(const std::string& text, const char* option);
// The requested scene: the file's, or one that holds the DEM alone; --exaggeration, --bend and
// --handle become settings of it, so that they are checked like a scene's keys. Throws
// Error(usage).
LoadedScene load(const DeformOptions& options);
// Whether the input is a scene file or the demo, not a DEM.
bool is_scene(const DeformOptions& options);

}  // namespace belvedere::tools
