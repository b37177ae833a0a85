#pragma once

#include <string>

#include "terrain/generalize.h"

namespace belvedere::tools {

// What an equalizer page is made of.
struct EqualizerInput {
  std::string title;              // the DEM's file name, for the page and its command line
  const Grid<float>& altitude_m;  // finite
  glm::dvec2 cell_m;              // on the ground
  GeneralizeParameters start;     // where the sliders stand at first; their number is the number of bands
  glm::dvec2 viewer_cell;         // where the viewer stands, in cells of the DEM
  glm::dvec2 distances_m;         // all foreground up to the first, all background from the second
  std::string viewer_options;     // that say the same on the command line
};

// A page of its own, without a network: sliders for each band (global, ridges, valleys; foreground and background), a shaded relief of the
// generalized terrain that is redrawn while they move, presets, and the command line that does the same to the whole DEM. It holds the DEM
// at a level of its own pyramid of at most 512 × 512 cells, so that what it shows is what the program makes at that level, and a part of it
// cell by cell; opened with #self-check it compares its arithmetic with altitudes made by generalize(). Masks and lakes are left to the
// program. Throws Error(output).
void write_equalizer_page(const std::string& path, const EqualizerInput& input, Progress& progress);

}  // namespace belvedere::tools
