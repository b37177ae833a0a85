#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "texture/quality/picture_measures.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Figures for the quality of a synthesis. Each measures one visible fault: blur, verbatim copies,
// repetition, wrong colours, cut strokes, speckles. None is sufficient alone, and none replaces
// looking at the picture.
// "Inside" a class is more than 8 pixels from the nearest border of classes, "at a border" at most
// 4. Grey is the mean of R, G, B.

struct ClassQuality {
  std::uint8_t label = 0;
  std::size_t pixels = 0;  // of the target
  std::size_t texels = 0;  // of all exemplars
  double sharpness =
      0.0;  // mean gradient of grey inside the class, output / exemplar; 0: no inside
  double clique_distance = 0.0;  // mean L1 distance (0…2) of histograms of grey differences over 20
                                 // pixel pairs up to 16 pixels apart
  double clique_floor =
      0.0;  // the same between the exemplar and the exemplar reweighted to the target's guide and
            // border distances: the effect of other altitudes and more borders alone
  double clique_beyond_floor =
      0.0;  // the same between the output and the reweighted exemplar: the effect of synthesis
  double colour_distance =
      0.0;                    // Wasserstein-1 of R, G, B, mean over the three, grey levels of 255
  double colour_floor = 0.0;  // as clique_floor
  double colour_beyond_floor = 0.0;  // as clique_beyond_floor
  double stroke_run = 0.0;           // mean run along the strokes, output / exemplar; 0: no inside
};

struct SynthesisQuality {
  double label_agreement = 0.0;   // share of matched pixels whose texel has their label
  double guide_error_mean = 0.0;  // of the requested guide, 0…255
  double guide_error_95 = 0.0;    // 95th percentile
  std::size_t without_texel = 0;  // pixels
  std::size_t excluded_used = 0;  // pixels that copy an excluded texel; must be 0
  int max_used = 0;               // max pixels that copy the same texel
  double texels_used = 0.0;       // share of texels that are used at all
  std::size_t largest_piece = 0;  // pixels copied with one offset, 4-connected
  double coherence = 0.0;         // share of 4-neighbours copied with one offset
  double across_silhouettes =
      0.0;                   // the same share among neighbours of different surfaces; must be 0
  double self_repeat = 0.0;  // distance to the most similar patch elsewhere in the picture, output
                             // / exemplar; < 1: repetitive
  double specks_inside = 0.0;  // pixels that differ from their 3 × 3 median by more than 30
                               // levels, output / exemplar
  double specks_border = 0.0;
  std::size_t exemplars = 0;  // paintings copied from or offered
  SeamsOfKinds seams;
  std::vector<ClassQuality> classes;  // of the target, by label
};

struct QualityParameters {
  std::string guide = "altitude";  // guide whose error is measured and to which the exemplar is
                                   // reweighted; "" or missing: none
  float depth_ratio = 1.04F;       // neighbours with a larger depth ratio are on different surfaces
  int repeat_samples = 400;        // patches compared for self_repeat; 0 skips it (it is slow)
};

// All figures. The picture is the copy that the matches describe. Throws Error(usage) if sizes
// differ or there is no exemplar.
SynthesisQuality measure_quality(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                                 const GuideStack& target,
                                 const QualityParameters& parameters = {});

// Sizes of the 4-connected pieces of constant offset, largest first.
std::vector<std::size_t> piece_sizes(const MatchField& matches);

}  // namespace belvedere
