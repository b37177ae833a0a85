#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/cli/elevation_options.h"
#include "tools/cli/fetch/fetch_options.h"
#include "tools/cli/scene_options.h"

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

}  // namespace belvedere::tools
