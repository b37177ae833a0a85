#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/matrix/matrix.h"
#include "base/progress.h"
#include "terrain/deform/displacement.h"
#include "terrain/register/control_pairs.h"
#include "terrain/register/fit_view.h"
#include "terrain/register/pair_fit.h"

namespace belvedere {

// Fewer pairs have no view. From these up to min_control_pairs it is good enough to say where a
// place may lie (registered_sigma_px), not to judge pairs: other places of register_trial are
// 22, 15 and 12 px off at the median with 5, 6 and 7 pairs, of a painting 1200 px wide.
constexpr std::size_t min_fitted_pairs = 5;

struct RegistrationParameters {
  FitViewParameters view;
  std::optional<double> sigma_px;  // how exactly pixels were clicked, of the painting, standard
                                   // deviation, 0.1…100; absent: estimated
};

// The judgement of a pair.
struct PairFinding {
  bool wrong = false;       // thrown out
  bool doubted = false;     // as far off as a wrong one, but sure
  bool would_fold = false;  // counts for less, because the ground would fold
  double view_px = 0.0;     // its distance from the view alone, in pixels of the painting
  double others_px = 0.0;   // from where all other pairs say that it is
  double deviations = 0.0;  // the same in standard deviations, as if it alone said that its ground
                            // was moved
  double nearest_m = 0.0;   // to the nearest pair that was kept
  std::size_t near_by = 0;  // kept pairs that tell how far its ground was moved
};

// The place of every pixel of a painting, as a view and a displacement of the ground.
struct Registration {
  double scale = 1.0;  // pixels of the painting per pixel of `frame`, which is 1200 px wide
  ViewFrame frame;
  ViewUnknowns view = {};
  std::vector<MovedMountain> mountains;
  DisplacementParameters displacement;
  double valleys_m = 0.0;     // by which the painter widened them; places lie on that ground
  double sigma_px = 0.0;      // of clicks, in pixels of the painting: as given, or estimated
  double score = 0.0;         // mean ln of how likely each kept pair is by the others
  std::size_t held_back = 0;  // pairs and places in the paint that count for less, because the
                              // ground would fold
  Matrix view_covariance;     // of the unknowns of the view, then of each mountain, given the pairs
                              // that were kept
  std::vector<PairFinding> findings;  // of all pairs, in their order
  std::vector<FittedView> kinds;      // the views from the pairs alone, best first
};

// Finds the view, and then where the painter moved the ground: kriging of the residuals over the
// map, with the view fitted again under its covariance, so that moved ground does not pull at it.
// Pairs are judged by what the others say (leave_out), thrown out worst first, a quarter of all at
// most; a pair must not vouch for itself, so the size of the displacement there is taken without
// it. Throws Error(usage) for values out of range and fewer than min_fitted_pairs, Error(input) as
// fit_views, and what `progress` throws.
Registration register_pairs(std::span<const ControlPair> pairs, glm::ivec2 painting_px,
                            const RegistrationParameters& parameters = {},
                            Progress& progress = silent_progress());

// A place that the paint itself shows.
struct PaintedPlace {
  ControlPair place;         // pixel of the painting
  glm::dvec2 sigma_px{1.0};  // of its pixel, standard deviation, > 0
};

// Registers again with places that were found in the paint beside the pairs. They count the less
// the less they agree with the others (Student's t with 4 degrees of freedom); pairs keep a quarter
// of their weight, and one that was thrown out comes back if it agrees now. Nothing if the others
// then tell the kept pairs worse than before: the paint was misread.
std::optional<Registration> refine_registration(const Registration& registration,
                                                std::span<const ControlPair> pairs,
                                                std::span<const PaintedPlace> painted);

// The painting's pixel that shows a place.
glm::dvec2 registered_pixel(const Registration& registration, const DisplacementField& field,
                            glm::dvec2 position, double altitude_m);

// How far that pixel may be off in one direction, standard deviation, without that of a click: the
// field's, and the view's, of which all is unsure where there are few pairs.
double registered_sigma_px(const Registration& registration, const DisplacementField& field,
                           glm::dvec2 position, double altitude_m);

// A painter stretches and squeezes the ground, but does not lay it over itself. Where the field
// would leave less than a fifth of the area that the handles of mountains leave, or let the ground
// fall by more than 0.8 m a metre away from the viewer, the place near by that agrees least with
// the others gets less weight until it does not; a sure pair only if there is no other. Sets the
// field's places by that. Returns the indices of the places with less weight, ascending.
std::vector<std::size_t> prevent_folds(PairFit& fit, double sigma_px);

}  // namespace belvedere
