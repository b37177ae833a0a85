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
  // Of a texture of 128² pixels made so (TextureFigures):
  double beyond = 0.0;
  double drawn = 0.0;
  double turned = 0.0;

  // Without `drawn` all is combed.
  double shape() const { return beyond + drawn; }
  // Without `turned` some is woven like cloth. Streaks wander over more than such a piece, so of them it says nothing.
  double score() const { return seed == TextureSeed::streaks ? shape() : shape() + turned; }
};

// What is not polished must be nearer than this times what is: dabs with edges, which no figure here knows, are worth some distance.
inline constexpr double unpolished_margin = .9;

// The shape of streaks must be nearer than this times that of anything else. What the measure likes a little better with them looks
// combed: undergrowth (.76 of the next), thicket (.90); strokes that are drawn come to .62 (Van Gogh) and .67 (a stubble field).
inline constexpr double streaks_margin = .7;

// How strokes run in a crop: the mean over its pixels of the direction along which it changes least, weighted by how much it changes
// across.
struct StrokeDirection {
  float deg = 0.F;     // clockwise from level, 0…180
  float spread = 0.F;  // 0: all one way, 1: no way more than another
};
StrokeDirection find_stroke_direction(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states);

// Sets seed, polish and direction of a model: white noise with and without polish, streaks of several lengths and small discs are made and
// measured by what no model knows. Larger discs come out as coins and scales and are for the hand. Returns what was tried, what
// was taken first.
std::vector<SeedTrial> choose_seed(CliqueModel& model, const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                                   const LearnParameters& parameters, Progress& progress = silent_progress());

}  // namespace belvedere
