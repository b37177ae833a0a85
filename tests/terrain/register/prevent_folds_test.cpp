#include "terrain/register/prevent_folds.h"

#include <gtest/gtest.h>

#include "terrain/deform/fold.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

// Exact pairs, the last two of which are side by side and were painted on each other's wrong
// side, or as far up and down.
PairFit crossed_fit(glm::dvec2 off_px) {
  PairFit fit;
  fit.pairs = test::synthetic_places(40);
  fit.pairs[38].position = {685000.0, 5256000.0};
  fit.pairs[39].position = {686500.0, 5256000.0};
  const test::SyntheticView view = test::synthetic_view(ViewKind::plane, fit.pairs);
  test::paint(view, fit.pairs);
  fit.pairs[38].pixel += off_px;
  fit.pairs[39].pixel -= off_px;
  fit.frame = view.frame;
  fit.view = view.view;
  fit.noise_px.assign(40, glm::dvec2(2.0));
  fit.weights.assign(40, 1.0);
  fit.field = field_of_extent(fit.frame.extent_m, 0.06);
  fit.field.places = displaced_places(fit);
  return fit;
}

// Facets of level ground about the pairs that are turned over.
std::size_t count_folds(const PairFit& fit) {
  const GeoTransform transform{668000.0, 5272000.0, 150.0, 150.0};
  DeformParameters parameters;
  parameters.handles = handles_of(fit.mountains);
  parameters.field = fit.field;
  const glm::dvec2 eye =
      fit.frame.origin +
      fit.frame.extent_m * glm::dvec2(fit.view[view_unknown::east], fit.view[view_unknown::north]);
  return find_folds(Grid<float>(220, 220, 1000.F), transform, Deformation(parameters, eye)).size();
}

TEST(PreventFolds, TwoStrongWrongPairsCannotFoldTheGround) {
  PairFit fit = crossed_fit({150.0, 0.0});
  ASSERT_GT(count_folds(fit), 100U);
  const std::vector<std::size_t> held_back = prevent_folds(fit, 2.0);
  EXPECT_EQ(count_folds(fit), 0U);
  ASSERT_FALSE(held_back.empty());
  for (const std::size_t i : held_back) EXPECT_GE(i, 38U);
}

TEST(PreventFolds, GroundDoesNotFallAwayFromTheViewerSteeperThanItsLimit) {
  PairFit fit = crossed_fit({0.0, 150.0});
  fit.pairs[39].position = {685000.0, 5257500.0};  // behind the other
  fit.field.places = displaced_places(fit);
  const auto steepest = [&] {
    const DisplacementField field(fit.field);
    double out = 0.0;
    for (double north = 5252000.0; north < 5262000.0; north += 50.0)
      out = std::max(out, (field.at({685000.0, north - 25.0}).upward_m -
                           field.at({685000.0, north + 25.0}).upward_m) /
                              50.0);
    return out;
  };
  const double before = steepest();
  prevent_folds(fit, 2.0);
  EXPECT_GT(before, 1.0);
  EXPECT_LT(steepest(), 0.9);
}

TEST(PreventFolds, GroundThatKeepsItsOrderIsLeftAlone) {
  PairFit fit = crossed_fit({0.0, 0.0});
  const std::vector<double> weights = fit.weights;
  EXPECT_TRUE(prevent_folds(fit, 2.0).empty());
  EXPECT_EQ(fit.weights, weights);
}

}  // namespace
}  // namespace belvedere
