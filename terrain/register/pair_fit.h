#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/matrix/matrix.h"
#include "terrain/deform/displacement.h"
#include "terrain/deform/handles.h"
#include "terrain/register/control_pairs.h"
#include "terrain/register/fit_view.h"
#include "terrain/register/view_model.h"

namespace belvedere {

// A mountain that the painter moved as a whole, as unknowns of a fit. All unknowns are expected to
// be 0 with a standard deviation of 1, L being the extent of the pairs:
//   centre     0.03 L to the east and north of the expected place
//   radius     0.11 L exp(0.35 x), the core 0.4 of it
//   move       0.03 L to the east and north, up to what folds no ground
//   turn       25°
//   raise      0.005 L
struct MovedMountain {
  static constexpr std::size_t unknowns = 7;  // centre (2), radius, move (2), turn, raise
  static constexpr double move = 0.03, raise = 0.005;
  glm::dvec2 expected{0.0};  // its centre, CRS
  double extent_m = 1.0;     // L
  std::array<double, unknowns> at = {};
};

DeformHandle handle_of(const MovedMountain& mountain);
std::vector<DeformHandle> handles_of(std::span<const MovedMountain> mountains);
// Whether handles may stand side by side: HandleField takes them.
bool are_apart(std::span<const DeformHandle> handles);

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

// The displacements that the view and moved mountains leave to the field: positions of the pairs,
// residual displacement and noise.
std::vector<DisplacedPlace> displaced_places(const PairFit& fit);

// Each pair by the others. One deviation of the view's priors weighs like two pixels of sigma_px.
PairJudgement judge_pairs(const PairFit& fit, double sigma_px);

// Covariance of the unknowns of the view, then of each mountain, given the pairs.
Matrix view_covariance(const PairFit& fit, double sigma_px);

// The view and the mountains' moves that are most likely under the field's covariance, with the
// field's places by them; nothing if no painting is seen like that.
std::optional<PairFit> refitted(const PairFit& fit, double sigma_px);

// Field and view in turn, as long as the others tell each pair no worse: a view that leaves much to
// the field is free to leave it more.
PairJudgement refine_pairs(PairFit& fit, double sigma_px, int rounds);

// A field as painters need it, of that length in extents.
DisplacementParameters field_of_extent(double extent_m, double length);

// The prediction error of a group of observations left out of the fit.
struct LeftOut {
  std::vector<double> residuals;  // observed less predicted
  Matrix covariance;              // of them, noise included
};

// Leaves out each group in turn, in closed form. Observations y = f(θ) + ε, ε of that covariance,
// θ of that prior precision (inverse covariance); `residuals` are y - f(θ) at the θ most likely by
// all, `slopes` the derivatives of f there. With C⁻¹ the inverse of covariance + slopes
// precision⁻¹ slopesᵀ, a group g has residuals ([C⁻¹]_gg)⁻¹ [covariance⁻¹ residuals]_g and
// covariance ([C⁻¹]_gg)⁻¹: exactly what a fit without the group gives if f is linear. Groups hold
// different indices of observations. Throws Error(bug) for matrices that are not positive definite.
std::vector<LeftOut> leave_out(const Matrix& covariance, const Matrix& slopes,
                               const Matrix& precision, std::span<const double> residuals,
                               std::span<const std::vector<std::size_t>> groups);

// A fit whose first pairs are those of `index`, in their order; places found in the paint follow.
struct WeighedPairs {
  PairFit fit;
  std::vector<std::size_t> index;
  PairJudgement judgement;
};

// Mean score of the pairs themselves.
double mean_score(const WeighedPairs& weighed);

// Robust weight under Student's t with 4 degrees of freedom, for the two coordinates together; .01
// where outliers are beyond doubt.
double weight_of(double square_deviations);

// Weights by agreement with the others, the view and mountains in turn; the likeliest of these
// rounds counts. Pairs keep a quarter of their weight.
void weigh_by_agreement(WeighedPairs& weighed, double sigma_px, int rounds);

}  // namespace belvedere
