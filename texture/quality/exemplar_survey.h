#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Survey of what a painting is suitable for, before anything is copied from it.

// Distribution of a guide's values in a class.
struct GuideTexels {
  std::string name;
  std::uint8_t lowest = 0;
  std::uint8_t highest = 0;
  std::uint8_t low = 0;  // 5th and 95th percentile: texels are frequent between them
  std::uint8_t high = 0;
  // Gaps of 16 or more steps between lowest and highest without any texel, both ends included.
  struct Gap {
    int from = 0;
    int to = 0;
  };
  std::vector<Gap> gaps;
};

// Dissimilarity of two halves of a class. Comparable with clique_distance and colour_distance of
// quality.h: no synthesis can be expected to be more similar to the painting than its own halves
// are to each other.
struct HalvesDistance {
  bool known = false;   // false: one half has too few texels
  double clique = 0.0;  // 0…2
  double colour = 0.0;  // grey levels
};

struct ClassSurvey {
  std::uint8_t label = 0;
  std::size_t texels = 0;
  std::size_t inside = 0;       // those more than 8 pixels from the nearest border of classes
  double sharpness = 0.0;       // mean gradient of grey inside, levels per pixel; 0: no inside
  double stroke_run_px = 0.0;   // mean length of strokes inside (quality.h); 0: no inside
  HalvesDistance left_right;    // is the style uniform?
  HalvesDistance checkerboard;  // of squares of 32 texels: the level of chance
  std::vector<GuideTexels> guides;
};

struct ExemplarSurvey {
  std::size_t texels = 0;    // of the whole picture
  std::size_t excluded = 0;  // labelled 255: lettering, frames …
  std::vector<ClassSurvey> classes;
};

// Throws as check_exemplar.
ExemplarSurvey survey_exemplar(const Exemplar& exemplar);

// How far a guide explains the paint of its class, in the exemplars that know it.
struct GuideShare {
  std::string name;
  double explained = 0.0;   // share of the variance within classes, of squares of 8 × 8 texels: of
                            // their colour or their contrast, whichever is larger; 0 by chance
  double difference = 0.0;  // mean squared difference of two random texels of a class, steps²
};
// Of every guide, in the order in which exemplars name them.
std::vector<GuideShare> explain_paint(const std::vector<Exemplar>& exemplars);

// Mean length of strokes (stroke_run) over all classes of the exemplars, texels; 0: not known.
double mean_stroke_px(const std::vector<Exemplar>& exemplars);

// How the texels of a class meet a guide of a target.
struct GuideFit {
  std::string name;
  double covered = 1.0;  // share of the target's pixels that find a texel within `reach` steps
  double square = 0.0;   // mean squared difference of pixels from the nearest texel, steps²
};
// For each guide of the target that an exemplar with texels of the class knows; each guide by
// itself.
std::vector<GuideFit> fit_guides(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                                 std::uint8_t label, int reach);

}  // namespace belvedere
