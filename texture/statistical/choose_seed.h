#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {

// A way to begin that was tried.
struct SeedTrial {
  TextureSeed seed = TextureSeed::white;
  float px = 0.F;
  bool polish = false;
  double beyond = 0.0;  // of a texture of 128² pixels made so (TextureFigures) …
  double drawn = 0.0;   // … whose sum is the least of those tried is taken: without the second all is combed

  double score() const { return beyond + drawn; }
};

// How strokes run in a crop: the mean over its pixels of the direction along which it changes least, weighted by how much it changes
// across.
struct StrokeDirection {
  float deg = 0.F;     // clockwise from level, 0…180
  float spread = 0.F;  // 0: all one way, 1: no way more than another
};
StrokeDirection find_stroke_direction(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states);

// Sets seed, polish and direction of a model: white noise with and without polish, streaks and discs of several sizes are made and measured
// by what no model knows. Returns what was tried, the best first.
std::vector<SeedTrial> choose_seed(CliqueModel& model, const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                                   const LearnParameters& parameters, Progress& progress = silent_progress());

}  // namespace belvedere
