#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "renderer/register/registered_ground.h"

namespace belvedere {

// All in pixels of the pictures that are compared.
struct MatchPaintParameters {
  int half_px = 20;              // half the side of a patch, 2…60
  glm::ivec2 reach_px{14, 12};   // largest shift, 1…15 across, 1…60 in height
  int spacing_px = 18;           // of the patches, ≥ 1
  double prior_px = 4.0;         // deviation of shifts to expect, at least, > 0
  double independent_px2 = 5.6;  // area within which paint says the same, > 0
};

// Where the paint shows a place of the ground's picture.
struct PaintMatch {
  glm::ivec2 pixel{0};       // of the ground's picture, which shows the place
  glm::dvec2 shift_px{0.0};  // from there to where the paint shows it
  glm::dvec2 sigma_px{0.0};  // of the shift: standard deviation by the paint alone
};

// Finds patches of the ground in the paint without knowledge of the light, palette and haze. A
// patch holds what lightness and colour may depend on: 1, the three components of the normal,
// altitude, ln of the distance, sky or not. At each shift their best linear combination explains a
// share R² of the paint's variance (weighted by a Hann window, three OKLab channels), which makes
// the shift as likely as
//   (1 - R²)^(-area / (2 independent)) exp(-|shift|² / (2 prior²)).
// Mean and variance over all shifts give the match, with the prior taken out again; a patch whose
// shift stays as unsure as expected is left out. `paint` is OKLab, of the size of the ground's
// picture.
std::vector<PaintMatch> match_paint(const Grid<glm::vec3>& paint, const RegisteredGround& ground,
                                    const MatchPaintParameters& parameters);

// How well the paint shows the ground where it is registered: for patches on a lattice, ln of the
// mean of that likelihood over the shifts of the prior; NaN where the ground's picture has sky.
Grid<double> paint_evidence(const Grid<glm::vec3>& paint, const RegisteredGround& ground,
                            const MatchPaintParameters& parameters);

}  // namespace belvedere
