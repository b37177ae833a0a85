#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// How good a synthesis is, in figures. Each looks at one fault that the eye finds: blur, quotation, repetition, wrong colours, cut
// strokes, speckles. None of them is enough alone, and none replaces looking at the picture.
//
// "Inside" a class is more than 8 pixels from the nearest border of classes, "at a border" at most 4. Grey is the mean of R, G, B.

struct ClassQuality {
  std::uint8_t label = 0;
  std::size_t pixels = 0;            // of the target
  std::size_t texels = 0;            // of all exemplars
  double sharpness = 0.0;            // mean gradient of grey inside the class, output / exemplar; 0: no inside
  double clique_distance = 0.0;      // mean L1 distance (0…2) of histograms of grey differences over 20 pixel pairs up to 16 pixels apart
  double clique_floor = 0.0;         // the same between the exemplar and the exemplar reweighted to the target's guide and border
                                     // distances: what other altitudes and more border make by themselves
  double clique_beyond_floor = 0.0;  // the same between the output and the reweighted exemplar: what synthesis adds
  double colour_distance = 0.0;      // Wasserstein-1 of R, G, B, mean over the three, grey levels of 255
  double colour_floor = 0.0;         // as clique_floor
  double colour_beyond_floor = 0.0;  // as clique_beyond_floor
  double stroke_run = 0.0;           // mean run along the strokes, output / exemplar; 0: no inside
};

// How much seams show: pixels side by side that were not side by side in a painting. Each step (|R − R'| + |G − G'| + |B − B'|) / 3 is set
// against what neighbours of the same two classes are apart in the paintings it comes from (the mean of the two paintings' means).
// Where neither has these classes side by side: what texels of the two classes are apart by chance, times the share of that by which the
// paintings' other borders step; a painting of another tone does not show there, for nothing tells how the classes would meet. 1: seams
// step as neighbours of the painting do.
struct SeamVisibility {
  std::size_t pairs = 0;     // of 4-neighbours, those across silhouettes left out: there the land itself steps
  std::size_t compared = 0;  // of those, the ones whose paintings have something to compare with
  double step = 0.0;         // mean over pairs, levels of 255
  double visibility = 0.0;   // sum of steps / sum of the paintings' own, over compared pairs; 0: none, or paintings without any step
};
struct SeamsOfKinds {
  SeamVisibility within;   // both pixels from one painting
  SeamVisibility between;  // from different paintings
};

struct SynthesisQuality {
  double label_agreement = 0.0;     // share of matched pixels whose texel has their label
  double guide_error_mean = 0.0;    // of the guide asked for, 0…255
  double guide_error_95 = 0.0;      // 95th percentile
  std::size_t without_texel = 0;    // pixels
  std::size_t excluded_used = 0;    // pixels that copy an excluded texel; must be 0
  int most_used = 0;                // pixels that copy one and the same texel
  double coverage = 0.0;            // share of texels that are used at all
  std::size_t largest_piece = 0;    // pixels copied by one offset, 4-connected
  double coherence = 0.0;           // share of 4-neighbours copied by one offset
  double across_silhouettes = 0.0;  // the same share among neighbours of different surfaces; must be 0
  double self_repeat = 0.0;         // distance to the most alike patch elsewhere in the picture, output / exemplar; < 1: repetitive
  double specks_inside = 0.0;       // pixels that stand out from their 3 × 3 median by more than 30 levels, output / exemplar
  double specks_border = 0.0;
  std::size_t exemplars = 0;  // paintings copied from or offered
  SeamsOfKinds seams;
  std::vector<ClassQuality> classes;  // those of the target, by label
};

struct QualityParameters {
  std::string guide = "altitude";  // the guide whose error is told and by which the exemplar is reweighted; "" or missing: none
  float depth_ratio = 1.04F;       // neighbours whose depths differ by more are of different surfaces
  int repeat_samples = 400;        // patches compared for self_repeat; 0 leaves it out (it is the slow one)
};

// All figures. The picture is what the matches copy. Throws Error(usage) where sizes disagree or there is no exemplar.
SynthesisQuality measure_quality(const MatchField& matches, const std::vector<Exemplar>& exemplars, const GuideStack& target,
                                 const QualityParameters& parameters = {});

// The parts, for one picture each.

// Squared distance to the nearest pixel on a border of classes (one that differs from its left or upper neighbour), at most 255.
Grid<std::uint8_t> border_distance_squared(const Grid<std::uint8_t>& labels);
// The parts below take it as `borders`.
// Mean grey gradient (central differences) inside a class; NaN where there is no inside.
double mean_gradient(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels, const Grid<std::uint8_t>& borders, std::uint8_t label);
// Mean length, in pixels, of the run through every third pixel inside a class, along the direction in which it is longest: the pixels of
// a run stay in the class and within `tolerance` (of r + g + b) of the pixel. At most 65. NaN where there is no inside.
double stroke_run(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels, const Grid<std::uint8_t>& borders, std::uint8_t label,
                  int tolerance);
// The tolerance that goes with an exemplar's class: half its median deviation of r + g + b over 7 × 7 pixels.
int stroke_tolerance(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels, std::uint8_t label);
// Share of pixels that stand out from the median of their 3 × 3, inside classes and at borders.
struct SpeckShares {
  double inside = 0.0;
  double border = 0.0;
};
SpeckShares speck_shares(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& borders);
// Sizes of the 4-connected pieces of constant offset, largest first.
std::vector<std::size_t> piece_sizes(const MatchField& matches);
// Seams inside paintings and between them. Matches must lie inside the exemplars; depth_m may be empty: no silhouettes.
SeamsOfKinds seam_visibility(const MatchField& matches, const std::vector<Exemplar>& exemplars, const Grid<float>& depth_m,
                             float depth_ratio);
// Mean over sampled 7 × 7 patches of the root mean squared difference to the most alike patch (every second pixel each way, every
// fourth in pictures over 1024 rows) that lies 16 pixels or more away.
double self_distance(const Grid<Rgb8>& picture, int samples);

}  // namespace belvedere
