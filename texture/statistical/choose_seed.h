#pragma once

#include <vector>

#include "base/progress.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {

// One tested kind of initial noise.
struct SeedTrial {
  TextureSeed seed = TextureSeed::white;
  float px = 0.F;
  bool polish = false;
  // Figures of a texture of 128² pixels made with this seed (TextureFigures):
  double beyond = 0.0;
  double drawn = 0.0;
  double turned = 0.0;

  // Without `drawn` everything looks combed.
  double shape() const { return beyond + drawn; }
  // Without `turned` some results look woven. Streaks meander over more than such a piece, so it is
  // meaningless for them.
  double score() const { return seed == TextureSeed::streaks ? shape() : shape() + turned; }
};

// An unpolished result must have less than this times the score of a polished one: dabs with edges,
// which no figure here measures, are worth some distance.
inline constexpr double unpolished_margin = .9;

// The shape score of streaks must be below this times that of anything else. Where the measure only
// slightly prefers them the result looks combed: undergrowth (.76 of the next), thicket (.90);
// drawn strokes reach .62 (Van Gogh) and .67 (a stubble field).
inline constexpr double streaks_margin = .7;

// The direction of strokes in a crop: the mean over its pixels of the direction of least change,
// weighted by the change across it.
struct StrokeDirection {
  float deg = 0.F;     // clockwise from horizontal, 0…180
  float spread = 0.F;  // 0: one direction, 1: no preferred direction
};
StrokeDirection find_stroke_direction(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states);

// Sets seed, polish and direction of a model: white noise with and without polish, streaks of
// several lengths and small discs are tried and measured by figures that no model contains. Larger
// discs come out as coins and scales and are only set by hand. Returns the trials, the chosen one
// first.
std::vector<SeedTrial> choose_seed(CliqueModel& model, const Grid<Rgb8>& crop,
                                   const Grid<std::uint8_t>& states,
                                   const LearnParameters& parameters,
                                   Progress& progress = silent_progress());

}  // namespace belvedere
