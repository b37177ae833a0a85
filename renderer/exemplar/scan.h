#pragma once

#include <utility>
#include <vector>

#include "base/progress.h"
#include "renderer/exemplar/fitted_ramps.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// A painting from files, ready for copying, and what was learnt of its colours.
struct ScannedPainting {
  PaintedExemplar painted;  // picture empty: the block has none, or an optional file is missing
  FittedRamps ramps;        // by class id
  std::vector<std::pair<double, glm::vec3>>
      sky;  // from its top (0) to its horizon (1); empty where the mask has no sky
  glm::vec3 cloud_light{1.0F};
  glm::vec3 cloud_shade{0.7F};
};

// The paintings of a scene's [[exemplar]] blocks, one result for each block. Each is a picture with
// a guidance file, or with a class mask and perhaps altitude, shadow and exclusion masks. Missing
// guides are estimated from the painting itself: the tone (painting_tone.h), cast shadow
// (shadow_texels.h), the direction of strokes (painting_strokes.h), the base picture
// (fitted_ramps.h). Colours are harmonized first if the scene requests it. An optional painting
// whose file is missing is noted.
std::vector<ScannedPainting> read_scans(const LoadedScene& scene, Progress& progress);

// Pixels of the scene's paintings together, by the headers of the files that exist.
double painting_texels(const LoadedScene& scene);

// Error(input) with the name of the file if a painting cannot be read whole or its guides have
// another size, Error(limit) if it takes too much memory: to be called before the work begins.
void check_paintings(const LoadedScene& scene);

// `palette` with the paintings' colours: ramps of their classes, weighted by texels and with enough
// light to show relief; for missing classes those of a fallback class, or the palette's own,
// shifted by the mean difference of the known classes from it; sky, clouds and air from a painted
// sky. Without any painting, the palette unchanged.
Palette take_colours(const Palette& palette, const std::vector<ScannedPainting>& scans,
                     const std::vector<std::pair<LandCoverClass, LandCoverClass>>& fallback);

}  // namespace belvedere
