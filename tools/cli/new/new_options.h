#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/compose/view_shape.h"
#include "tools/cli/command_fetch.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terrain_operators.h"

namespace belvedere::tools {

// Command-line options of `belvedere new`.
struct NewOptions {
  SceneOptions common;
  FetchOptions fetch;   // --at: the data come from map services
  std::string fetched;  // folder for them; empty: beside the scene
  std::vector<std::string> dems;
  std::string out;
  std::string pictures;
  std::string title;
  std::string style;
  std::string crs;
  ElevationOptions elevation;  // of the files of `dems`
  std::optional<double> lowest_m;
  int choose = 1;
  int max = 5;
  std::string towards, from, format = "2:1";
  std::vector<std::string> include;
  struct Cover {
    std::string file, legend, crs, unknown, variable;
    int band = 1;
  } cover;
  bool plain = false;
  bool force = false;
};

void add_new_options(CommandOptions& command, NewOptions& options);

// Writes a scene of a region with the best view, or the one that is chosen: `belvedere new`.
int make_new_scene(const NewOptions& options);
// The text of that scene with the best view, for a file options.out; nothing is written but what
// --at fetches.
std::string new_scene_text(const NewOptions& options, const Cache& cache, Progress& progress);

// Parsing of command-line values of `belvedere new`. All throw Error(usage) naming the option.

// "N", "northeast", "225": azimuth in degrees, 0…360.
double read_direction(const std::string& text);

// "LON,LAT", degrees.
glm::dvec2 read_lonlat(const std::string& option, const std::string& text);

// "NAME|LON,LAT" or "LON,LAT".
struct NamedPlace {
  std::string name;
  glm::dvec2 lonlat{0.0};
};
NamedPlace read_named_place(const std::string& text);

// The shape of the sheet and its width in print: "3:1", "A2" (landscape), "A2 upright", "1600x900"
// or "cylinder".
struct SheetFormat {
  ViewFormat picture;
  double sheet_width_mm = 1200.0;
  int width_px = 2400;
};
SheetFormat read_format(const std::string& text);

}  // namespace belvedere::tools
