#pragma once

#include <string>

#include "terrain/generalize/generalize.h"
#include "terrain/generalize/mask.h"

namespace belvedere::tools {

// Which of the masks and lakes count.
struct EqualizerSwitches {
  bool lakes = true;  // keep their level
  bool foot = false;  // nothing is exaggerated on flat ground at the foot of slopes
  bool slope = false;
  bool drawn = false;
};

// What an equalizer page is made of.
struct EqualizerInput {
  std::string title;              // the DEM's file name, for the page and its command line
  const Grid<float>& altitude_m;  // finite
  glm::dvec2 cell_m;              // on the ground
  // Where the sliders stand at first; their number is the number of bands. How break lines are found is the same for all that is shown.
  GeneralizeParameters start;
  glm::dvec2 viewer_cell;      // where the viewer stands, in cells of the DEM
  glm::dvec2 distances_m;      // all foreground up to the first, all background from the second
  std::string viewer_options;  // that say the same on the command line
  std::string other_options;   // of the command line that no slider or switch stands for, each with a blank before it
  // What protects terrain, each of the DEM's size; a switch on the page lets each count or not.
  const Grid<unsigned char>& lakes;  // != 0 in lakes
  const Grid<float>& foot_mask;      // for GeneralizeGrids::amplification_mask
  const Grid<float>& slope_mask;
  const Grid<float>& drawn_mask;  // empty: there is none
  SlopeRange slope_range;         // of slope_mask
  std::string drawn_name;         // of the drawn mask's file
  EqualizerSwitches switches;     // as they stand at first
};

// A page of its own, without a network: sliders for each band (global, ridges, valleys; foreground and background), switches for lakes and
// masks, a shaded relief of the generalized terrain that is redrawn while they move, presets, and the command line that does the same to
// the whole DEM. It holds the DEM at a level of its own pyramid of at most 512 × 512 cells, so that what it shows is what the program makes
// at that level, and a part of it cell by cell; masks go to that level through the pyramid too, of lakes it takes every cell that stays.
// Opened with #self-check it compares its arithmetic with altitudes made by generalize(): they agree to a millimetre, level places to a
// centimetre. Throws Error(output).
void write_equalizer_page(const std::string& path, const EqualizerInput& input, Progress& progress);

}  // namespace belvedere::tools
