#pragma once

#include <string>

#include "terrain/generalize/generalize.h"
#include "terrain/generalize/mask.h"

namespace belvedere::tools {

// Which of the masks and lakes apply.
struct EqualizerSwitches {
  bool lakes = true;  // keep their level
  bool foot = false;  // no exaggeration on flat ground at the foot of slopes
  bool slope = false;
  bool drawn = false;
};

// Input of an equalizer page.
struct EqualizerInput {
  std::string title;              // the DEM's file name, for the page and its command line
  const Grid<float>& altitude_m;  // finite
  glm::dvec2 cell_m;              // on the ground
  // Initial position of the sliders; their number is the number of bands. How break lines are found
  // is the same for everything shown.
  GeneralizeParameters start;
  glm::dvec2 viewer_cell;      // position of the viewer, in cells of the DEM
  glm::dvec2 distances_m;      // only foreground up to the first, only background from the second
  std::string viewer_options;  // the same on the command line
  std::string other_options;   // options without a slider or switch, each with a space before it
  // Protected terrain, each of the DEM's size; a switch on the page lets each apply or not.
  const Grid<unsigned char>& lakes;  // != 0 in lakes
  const Grid<float>& foot_mask;      // for GeneralizeGrids::amplification_mask
  const Grid<float>& slope_mask;
  const Grid<float>& drawn_mask;  // empty: there is none
  SlopeRange slope_range;         // of slope_mask
  std::string drawn_name;         // of the drawn mask's file
  EqualizerSwitches switches;     // initial state
};

// A self-contained page without network access: sliders for each band (global, ridges, valleys;
// foreground and background), switches for lakes and masks, a shaded relief of the generalized
// terrain that is redrawn while they move, presets, and the command line that does the same to the
// whole DEM. It contains the DEM at a level of its own pyramid of at most 512 × 512 cells, so that
// the preview equals the program's result at that level, and a part of it cell by cell; masks are
// reduced to that level by the pyramid too, lakes keep every cell that has water. Opened with
// #self-check it compares its arithmetic with altitudes made by generalize(): they agree to a
// millimetre, level places to a centimetre. Throws Error(output).
void write_equalizer_page(const std::string& path, const EqualizerInput& input, Progress& progress);

}  // namespace belvedere::tools
