#include "terrain/register/fit_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

constexpr std::array every_kind = {ViewKind::cylinder, ViewKind::panini, ViewKind::plane};

// The largest distance of places that were not fitted.
double worst_px(const FittedView& fitted, const test::SyntheticView& truth) {
  double worst = 0.0;
  for (const ControlPair& place : test::synthetic_places(200, 77)) {
    const ViewPixel at =
        project_in_view(fitted.frame, fitted.view, place.position, place.altitude_m);
    worst = std::max(
        worst, glm::length(glm::dvec2(at.u.value, at.v.value) - test::pixel_of(truth, place)));
  }
  return worst;
}

TEST(FitView, FindsASyntheticViewExactlyAndItsKind) {
  for (const ViewKind kind : every_kind) {
    std::vector<ControlPair> pairs = test::synthetic_places(40);
    const test::SyntheticView truth = test::synthetic_view(kind, pairs);
    test::paint(truth, pairs);
    const std::vector<FittedView> views = fit_views(pairs, test::synthetic_size);
    ASSERT_EQ(views.size(), 3U);
    EXPECT_EQ(views.front().frame.kind, kind);
    EXPECT_LT(views.front().cost, 0.1 * views[1].cost);
    EXPECT_LT(worst_px(views.front(), truth), 0.02) << view_kind_name(kind);
    for (const std::size_t i : {view_unknown::east, view_unknown::north, view_unknown::azimuth})
      EXPECT_NEAR(views.front().view[i], truth.view[i], 1e-4);
  }
}

TEST(FitView, PriorsHardlyBendAViewThatIsNotAsTheyExpect) {
  std::vector<ControlPair> pairs = test::synthetic_places(40);
  test::SyntheticView truth = test::synthetic_view(ViewKind::plane, pairs);
  truth.view[view_unknown::exaggeration] = 1.9;
  truth.view[view_unknown::exaggeration + 1] = 0.3;
  truth.view[view_unknown::drop + 2] = 0.1;
  truth.view[view_unknown::bend + 1] = 0.1;
  test::paint(truth, pairs);
  EXPECT_LT(worst_px(fit_views(pairs, test::synthetic_size).front(), truth), 1.5);
}

TEST(FitView, GrossErrorsHaveNoEffect) {
  std::vector<ControlPair> pairs = test::synthetic_places(40);
  const test::SyntheticView truth = test::synthetic_view(ViewKind::cylinder, pairs);
  test::paint(truth, pairs);
  for (std::size_t i = 0; i < pairs.size(); i += 5) pairs[i].pixel += glm::dvec2(150.0, -80.0);
  const FittedView view =
      fit_views(pairs, test::synthetic_size, {.kinds = {ViewKind::cylinder}}).front();
  EXPECT_LT(worst_px(view, truth), 1.0);
  EXPECT_LT(view.median_px, 0.2);
}

TEST(FitView, ACroppedPaintingsMiddleIsFoundIfAskedFor) {
  std::vector<ControlPair> pairs = test::synthetic_places(60);
  test::SyntheticView truth = test::synthetic_view(ViewKind::plane, pairs);
  truth.view[view_unknown::middle] = 0.12;
  truth.view[view_unknown::middle + 1] = 0.05;
  test::paint(truth, pairs);
  const std::vector<ViewKind> kinds = {ViewKind::plane};
  EXPECT_GT(worst_px(fit_views(pairs, test::synthetic_size, {.kinds = kinds}).front(), truth), 5.0);
  const FittedView cropped =
      fit_views(pairs, test::synthetic_size, {.kinds = kinds, .cropped = true}).front();
  EXPECT_LT(worst_px(cropped, truth), 1.0);
}

TEST(FitView, PairsWithoutAnyViewAreRefused) {
  std::vector<ControlPair> pairs = test::synthetic_places(20);
  for (ControlPair& pair : pairs) pair.pixel = {600.0, 200.0};
  EXPECT_THROW(fit_views(pairs, test::synthetic_size), Error);
}

}  // namespace
}  // namespace belvedere
