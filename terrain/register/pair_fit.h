#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "base/matrix/least_squares.h"
#include "base/matrix/matrix.h"
#include "terrain/deform/displacement.h"
#include "terrain/register/control_pairs.h"
#include "terrain/register/fit_view.h"
#include "terrain/register/moved_mountain.h"
#include "terrain/register/view_model.h"

namespace belvedere {

// A view and a field for the pairs that count.
struct PairFit {
  std::vector<ControlPair> pairs;    // pixels as in `frame`
  std::vector<glm::dvec2> noise_px;  // of their pixels, standard deviation, > 0
  std::vector<double> weights;       // of a pair, 0…1: its noise counts as noise / √weight
  ViewFrame frame;
  ViewUnknowns view = {};
  std::vector<MovedMountain> mountains;
  DisplacementParameters field;  // its places are the pairs, in their order
};

// How the field and the view explain the pairs.
struct PairJudgement {
  std::vector<double> others_px;   // distance of a pair from where the others say it is
  std::vector<double> deviations;  // the same in standard deviations, as if its ground had the size
                                   // of displacement that the others give it
  std::vector<double> square_deviations;  // the same squared, with the size that the field has, of
                                          // the noise without its weight
  std::vector<double> scores;             // ln of how likely it is by the others
  double score = 0.0;                     // their sum
};

// A pair at the place that handles move its ground to.
ControlPair moved_by(const HandleField& handles, ControlPair pair);

// How far the pairs' ground is displaced beside what mountains move, m: lateral of all, then
// upward; and the derivatives by the view's unknowns, then by those of each mountain.
Residuals displacements(const PairFit& fit);

// What the view and moved mountains leave to the field: where the pairs lie, how far they moved,
// and their noise.
std::vector<DisplacedPlace> displaced_places(const PairFit& fit);

// Each pair by the others. One deviation of the view's priors weighs like two pixels of sigma_px.
PairJudgement judge_pairs(const PairFit& fit, double sigma_px);

// Covariance of the view's unknowns given the pairs.
Matrix view_covariance(const PairFit& fit, double sigma_px);

// The view and the mountains' moves that are most likely under the field's covariance, with the
// field's places by them; nothing if no painting is seen like that.
std::optional<PairFit> refitted(const PairFit& fit, double sigma_px);

// Field and view in turn, as long as the others tell each pair no worse: a view that leaves much to
// the field is free to leave it more.
PairJudgement refine_pairs(PairFit& fit, double sigma_px, int rounds);

// A field as painters need it, of that length in extents.
DisplacementParameters field_of_extent(double extent_m, double length);

}  // namespace belvedere
