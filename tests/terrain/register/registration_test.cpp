#include "terrain/register/registration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/math.h"
#include "base/random.h"
#include "base/statistics.h"
#include "terrain/deform/deform.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

constexpr glm::dvec2 moved_centre(686000.0, 5256000.0);

// Ground within 6 km of a place is 600 m to the right and 200 m up, less towards the edge.
Displacement moved_at(glm::dvec2 position) {
  const double share = 1.0 - smoothstep(3000.0, 6000.0, glm::length(position - moved_centre));
  return {600.0 * share, 200.0 * share};
}

// Pairs with noise; if `moved`, on ground that is moved in part.
std::vector<ControlPair> painted_pairs(std::size_t count, double sigma_px, bool moved,
                                       test::SyntheticView& truth) {
  std::vector<ControlPair> pairs = test::synthetic_places(count);
  truth = test::synthetic_view(ViewKind::plane, pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto n = static_cast<std::int64_t>(i);
    pairs[i].pixel =
        test::pixel_of(truth, pairs[i], moved ? moved_at(pairs[i].position) : Displacement{});
    pairs[i].pixel.x += sigma_px * random_normal(5, n, 0);
    pairs[i].pixel.y += sigma_px * random_normal(5, n, 1);
  }
  return pairs;
}

// Distances of places that are not among the pairs, px.
std::vector<double> distances_px(const Registration& found, const test::SyntheticView& truth,
                                 bool moved, bool inside) {
  const DisplacementField field(found.displacement);
  std::vector<double> out;
  for (const ControlPair& place : test::synthetic_places(400, 77)) {
    if ((glm::length(place.position - moved_centre) < 4000.0) != inside) continue;
    const glm::dvec2 true_pixel =
        found.scale *
        test::pixel_of(truth, place, moved ? moved_at(place.position) : Displacement{});
    out.push_back(
        glm::length(registered_pixel(found, field, place.position, place.altitude_m) - true_pixel));
  }
  return out;
}

std::size_t count_wrong(const Registration& found) {
  return static_cast<std::size_t>(std::count_if(found.findings.begin(), found.findings.end(),
                                                [](const PairFinding& f) { return f.wrong; }));
}

TEST(Registration, ExactPairsOfStillGroundAreAllKept) {
  test::SyntheticView truth;
  const Registration found = register_pairs(painted_pairs(40, 0.0, false, truth), {1200, 550});
  EXPECT_EQ(count_wrong(found), 0U);
  EXPECT_EQ(found.frame.kind, ViewKind::plane);
  const std::vector<double> off = distances_px(found, truth, false, false);
  EXPECT_LT(*std::max_element(off.begin(), off.end()), 0.2);
  for (const PairFinding& finding : found.findings) EXPECT_LT(finding.others_px, 0.5);
}

TEST(Registration, GroundThatWasMovedIsFollowedAndTheRestStaysStill) {
  test::SyntheticView truth;
  const std::vector<ControlPair> pairs = painted_pairs(120, 1.0, true, truth);
  const Registration found = register_pairs(pairs, {1200, 550}, {.view = {}, .sigma_px = 1.0});
  EXPECT_LE(count_wrong(found), 1U);
  // The view alone is 15 px off inside.
  EXPECT_LT(median(distances_px(found, truth, true, true)), 4.0);
  EXPECT_LT(median(distances_px(found, truth, true, false)), 1.2);
  const Displacement there = DisplacementField(found.displacement).at(moved_centre);
  EXPECT_NEAR(there.lateral_m, 600.0, 120.0);
  EXPECT_NEAR(there.upward_m, 200.0, 100.0);
}

TEST(Registration, WrongPairsAreFoundAndSureOnesAreKept) {
  test::SyntheticView truth;
  std::vector<ControlPair> pairs = painted_pairs(40, 2.0, false, truth);
  for (const std::size_t i : {3U, 12U, 20U, 33U}) pairs[i].pixel += glm::dvec2(90.0, -40.0);
  pairs[20].sure = true;
  const Registration found = register_pairs(pairs, {1200, 550});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(found.findings[i].wrong, i == 3 || i == 12 || i == 33) << i;
    EXPECT_EQ(found.findings[i].doubted, i == 20) << i;
  }
  EXPECT_GT(found.findings[3].others_px, 60.0);
  EXPECT_GT(found.findings[20].deviations, 5.0);
}

TEST(Registration, NoiseIsEstimatedUnlessItIsGiven) {
  test::SyntheticView truth;
  EXPECT_GE(register_pairs(painted_pairs(40, 6.0, false, truth), {1200, 550}).sigma_px, 4.5);
  const std::vector<ControlPair> fine = painted_pairs(40, 1.0, false, truth);
  EXPECT_LE(register_pairs(fine, {1200, 550}).sigma_px, 2.0);
  EXPECT_EQ(register_pairs(fine, {1200, 550}, {.view = {}, .sigma_px = 4.0}).sigma_px, 4.0);
  EXPECT_THROW(register_pairs(fine, {1200, 550}, {.view = {}, .sigma_px = 0.0}), Error);
}

// Places found in the paint, of which a fifth are wrong, on ground that is moved.
std::vector<PaintedPlace> painted_places(const test::SyntheticView& truth, glm::dvec2 shift) {
  std::vector<PaintedPlace> out;
  for (const ControlPair& place : test::synthetic_places(60, 31)) {
    const auto n = static_cast<std::int64_t>(out.size());
    PaintedPlace painted{place, glm::dvec2(1.0)};
    painted.place.pixel = test::pixel_of(truth, place, moved_at(place.position)) + shift +
                          glm::dvec2(random_normal(8, n, 0), random_normal(8, n, 1));
    if (n % 5 == 0) painted.place.pixel += glm::dvec2(25.0, -20.0);
    out.push_back(painted);
  }
  return out;
}

TEST(Registration, PlacesFoundInThePaintImproveItAlthoughSomeAreWrong) {
  test::SyntheticView truth;
  std::vector<ControlPair> pairs = painted_pairs(40, 3.0, true, truth);
  pairs[11].pixel += glm::dvec2(80.0, 30.0);
  const Registration by_pairs = register_pairs(pairs, {1200, 550}, {.view = {}, .sigma_px = 3.0});
  const auto better = refine_registration(by_pairs, pairs, painted_places(truth, {0.0, 0.0}));
  ASSERT_TRUE(better);
  for (const bool inside : {false, true})
    EXPECT_LT(median(distances_px(*better, truth, true, inside)),
              0.7 * median(distances_px(by_pairs, truth, true, inside)));
  EXPECT_TRUE(better->findings[11].wrong);
  EXPECT_GT(better->score, by_pairs.score);
}

TEST(Registration, PaintThatContradictsThePairsIsNotBelieved) {
  test::SyntheticView truth;
  const std::vector<ControlPair> pairs = painted_pairs(40, 1.0, false, truth);
  const Registration by_pairs = register_pairs(pairs, {1200, 550}, {.view = {}, .sigma_px = 1.0});
  EXPECT_FALSE(refine_registration(by_pairs, pairs, painted_places(truth, {9.0, -9.0})));
}

// Pairs that no view explains are refused, or registered as badly as they are; never more.
TEST(Registration, NonsenseIsNoFaultOfTheProgram) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    std::vector<ControlPair> anywhere = test::synthetic_places(12, seed);
    std::vector<ControlPair> in_line = anywhere;
    const test::SyntheticView truth = test::synthetic_view(ViewKind::plane, anywhere);
    for (std::size_t i = 0; i < anywhere.size(); ++i) {
      const auto n = static_cast<std::int64_t>(i);
      anywhere[i].pixel.x = 1200.0 * random_uniform(seed, n, 5);
      anywhere[i].pixel.y = 550.0 * random_uniform(seed, n, 6);
      in_line[i].pixel = test::pixel_of(truth, in_line[i]);
      in_line[i].position.y = 5250000.0;
    }
    for (const std::vector<ControlPair>& pairs : {anywhere, in_line}) try {
        for (const double value : register_pairs(pairs, {1200, 550}).view)
          EXPECT_TRUE(std::isfinite(value));
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
      }
  }
}

TEST(Registration, APaintingFourTimesAsLargeIsTheSame) {
  test::SyntheticView truth;
  std::vector<ControlPair> pairs = painted_pairs(40, 2.0, true, truth);
  const Registration small = register_pairs(pairs, {1200, 550});
  for (ControlPair& pair : pairs) pair.pixel *= 4.0;
  const Registration large = register_pairs(pairs, {4800, 2200});
  EXPECT_EQ(small.view, large.view);
  EXPECT_EQ(large.sigma_px, 4.0 * small.sigma_px);
  EXPECT_EQ(large.scale, 4.0);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    EXPECT_NEAR(large.findings[i].others_px, 4.0 * small.findings[i].others_px, 1e-9);
}

TEST(Registration, FewPairsSayHowLittleTheyKnow) {
  double unsure_px = 20.0;
  for (const std::size_t count : {5U, 6U, 7U, 20U}) {
    test::SyntheticView truth;
    const std::vector<ControlPair> pairs = painted_pairs(count, 1.0, false, truth);
    const Registration found = register_pairs(pairs, {1200, 550}, {.view = {}, .sigma_px = 1.0});
    const DisplacementField field(found.displacement);
    std::vector<double> share, sigma;  // off, of its deviation
    for (const ControlPair& place : test::synthetic_places(200, 77)) {
      sigma.push_back(registered_sigma_px(found, field, place.position, place.altitude_m));
      share.push_back(glm::length(registered_pixel(found, field, place.position, place.altitude_m) -
                                  test::pixel_of(truth, place)) /
                      sigma.back());
    }
    EXPECT_LT(median(share), 3.0) << count;  // 1.2 for a normal distribution in both directions
    EXPECT_LT(median(sigma), unsure_px) << count << " pairs know more";
    unsure_px = median(sigma);
  }
  test::SyntheticView truth;
  EXPECT_THROW(register_pairs(painted_pairs(4, 1.0, false, truth), {1200, 550}), Error);
}

TEST(Registration, EndsWhenItIsNoLongerWanted) {
  class Unwanted : public Progress {
   public:
    void advance(double) override { throw Error(ErrorKind::interrupted, "pairs", "superseded"); }
  } progress;
  test::SyntheticView truth;
  const std::vector<ControlPair> pairs = painted_pairs(20, 1.0, false, truth);
  EXPECT_EQ(test::error_of([&] {
              register_pairs(pairs, {1200, 550}, {}, progress);
            }).kind(),
            ErrorKind::interrupted);
}

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
