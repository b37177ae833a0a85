#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/io/dem.h"
#include "terrain/layers/fit/ground_fit.h"
#include "tools/cli/terrain_operators.h"

namespace belvedere::tools {

// Input of a fit: a DEM, and a picture or a map of classes with its legend, by paths.
struct FitSources {
  ElevationOptions elevation;  // of `dem`
  std::string dem, image, classes, legend;
  std::string mask;     // cells that are left out; may be empty
  std::string regions;  // of a picture's colours; may be empty
  std::vector<int>
      bands;          // red, green, blue and shortwave infrared of `image`, from 1; may be empty
  bool haze = false;  // take the blue cast out of the picture
  std::optional<double> grey_hue_deg;
  std::optional<double> snow_from_m;
};

// Findings for the terminal and for the report.
struct FitFindings {
  std::vector<std::string> notes;
  void note(std::string text) { notes.push_back(std::move(text)); }
};

struct FitGround {
  Dem dem;
  Grid<std::uint8_t> use;  // 0: void, masked, outside the picture
  std::optional<Grid<glm::vec3>> rgb;
  std::optional<Grid<float>> swir;  // shortwave infrared
};

// The DEM, on the picture's own cells if that has coordinates, without what is masked. Error(input)
// where picture and DEM do not belong together.
FitGround read_fit_ground(const FitSources& from, FitFindings& findings, Progress& progress);

// The classes on it, by the picture's colours or by the map. Error(input) where the map does not
// overlap.
KnownGround find_ground_classes(const FitSources& from, const FitGround& ground,
                                FitFindings& findings, Progress& progress);

}  // namespace belvedere::tools
