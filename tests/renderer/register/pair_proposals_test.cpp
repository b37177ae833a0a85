#include "renderer/register/pair_proposals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/register/registered_ground.h"
#include "terrain/io/crs.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

using testing::ElementsAre;
using testing::Field;

// Three cones on a plain of 500 m, 200 m to a cell: 900, 700 and 540 m high, at cells (20, 20),
// (60, 30) and (40, 60).
Dem three_summits() {
  const auto cone = [](double x, double y, double height) {
    return height - 40.0 * std::hypot(x, y);
  };
  return make_dem({test::grid_of(80, 80,
                                 [&](int x, int y) {
                                   return 500.0 + std::max({0.0, cone(x - 20, y - 20, 400.0),
                                                            cone(x - 60, y - 30, 200.0),
                                                            cone(x - 40, y - 60, 40.0)});
                                 }),
                   {660000.0, 5280000.0, 200.0, 200.0},
                   normalize_crs("EPSG:32632")});
}
glm::dvec2 centre_of(int x, int y) { return {660100.0 + 200.0 * x, 5279900.0 - 200.0 * y}; }

TEST(MeasuredAltitude, LiesBetweenCellsAndNowhereWithoutData) {
  Dem dem = make_dem({test::grid_of(5, 4, [](int x, int y) { return 100.0 * x + 10.0 * y; }),
                      {0.0, 400.0, 100.0, 100.0},
                      normalize_crs("EPSG:32632")});
  dem.filled = Grid<std::uint8_t>(5, 4);
  dem.filled(3, 2) = 1;
  EXPECT_EQ(measured_altitude_m(dem, dem.transform.to_crs(1.5, 1.0)), 160.0);
  EXPECT_EQ(measured_altitude_m(dem, dem.transform.to_crs(4.0, 3.0)), 430.0);
  EXPECT_FALSE(measured_altitude_m(dem, dem.transform.to_crs(3.2, 1.8)));
  EXPECT_FALSE(measured_altitude_m(dem, dem.transform.to_crs(4.1, 1.0)));
}

TEST(PairProposals, SummitsHaveTheirNamesAndOtherPlacesTheirAltitude) {
  const Dem dem = three_summits();
  const std::vector<NamedPlace> named = {
      {"High", centre_of(20, 20) + glm::dvec2(250.0, 0.0), true},
      {"Elsewhere", centre_of(60, 30) + glm::dvec2(0.0, 500.0), true},
      {"Village", centre_of(40, 60), false},
      {"Outside", {0.0, 0.0}, false}};
  const std::vector<KnownPlace> places = known_places(dem, named);
  ASSERT_EQ(places.size(), 5U) << "the village lies on a summit, and is none";
  EXPECT_EQ(places[0].name, "High");
  EXPECT_EQ(places[0].position, centre_of(20, 20)) << "the summit's, not the file's";
  EXPECT_EQ(places[0].altitude_m, 900.0);
  EXPECT_EQ(places[0].prominence_m, 400.0);
  EXPECT_EQ(places[1].name, "") << "its name is farther than near by";
  EXPECT_EQ(places[1].prominence_m, 200.0);
  EXPECT_EQ(places[2].prominence_m, 40.0);
  EXPECT_EQ(places[3].name, "Elsewhere");
  EXPECT_EQ(places[3].prominence_m, 0.0);
  EXPECT_NEAR(places[3].altitude_m, 600.0, 1e-3) << "700 - 40 · 2.5";
  EXPECT_EQ(places[4].name, "Village");
  EXPECT_EQ(known_places(dem, named, {.min_prominence_m = 150.0}).size(), 4U);
}

TEST(PairProposals, AVoidThatWasFilledHasNoSummit) {
  Dem dem = three_summits();
  dem.filled = Grid<std::uint8_t>(80, 80);
  for (const auto [x, y] : test::cells({10, 10, 30, 30})) dem.filled(x, y) = 1;
  const std::vector<KnownPlace> places = known_places(dem, {});
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0].altitude_m, 700.0);
}

TEST(PairProposals, AClickTakesTheNearestPlaceWithinItsRadius) {
  const std::vector<KnownPlace> places = {{.name = "a", .position = {0.0, 0.0}},
                                          {.name = "b", .position = {100.0, 0.0}},
                                          {.name = "c", .position = {100.0, 0.0}}};
  EXPECT_EQ(nearest_place(places, {49.0, 0.0}, 60.0), 0U);
  EXPECT_EQ(nearest_place(places, {51.0, 0.0}, 60.0), 1U) << "of equal ones the first";
  EXPECT_EQ(nearest_place(places, {0.0, 60.0}, 60.0), 0U) << "the radius counts";
  EXPECT_FALSE(nearest_place(places, {0.0, 60.1}, 60.0));
  EXPECT_FALSE(nearest_place({}, {0.0, 0.0}, 60.0));
}

// Pairs of a known view; the places between them are proposed where that view shows them.
TEST(PairProposals, PixelsAreThoseOfTheView) {
  std::vector<ControlPair> pairs = test::synthetic_places(60);
  const test::SyntheticView truth = test::synthetic_view(ViewKind::cylinder, pairs);
  test::paint(truth, pairs);
  const std::vector<ControlPair> others(pairs.begin() + 40, pairs.end());
  pairs.resize(40);
  const Registration found = register_pairs(pairs, {1200, 550});
  const DisplacementField field(found.displacement);
  for (const ControlPair& other : others) {
    const ProposedPixel proposed = propose_pixel(
        found, field, {.name = "", .position = other.position, .altitude_m = other.altitude_m});
    EXPECT_LT(glm::length(proposed.pixel - other.pixel), 1.0);
    EXPECT_LT(proposed.sigma_px, 12.0);
    EXPECT_GE(proposed.sigma_px, found.sigma_px);
  }
}

TEST(PairProposals, PlacesAreNearAndStandOut) {
  const std::vector<KnownPlace> places = {
      {.name = "", .position = {}, .altitude_m = 0.0, .prominence_m = 40.0},
      {.name = "", .position = {}, .altitude_m = 0.0, .prominence_m = 400.0},
      {.name = "hut", .position = {}, .altitude_m = 0.0, .prominence_m = 0.0},
      {.name = "", .position = {}, .altitude_m = 0.0, .prominence_m = 4000.0}};
  const auto numbers = [&](const std::vector<ProposedPixel>& pixels, std::vector<bool> seen,
                           double scale = 1.0) {
    std::vector<std::size_t> out;
    for (const ProposedPlace& proposed :
         propose_places(places, pixels, seen, {100.0, 100.0}, scale))
      out.push_back(proposed.place);
    return out;
  };
  const std::vector<bool> all(4, true);
  // 3 and 5 px away, deviation 4: the ratio of likelihoods is 10 exp(-1/2) = 6 for the higher one.
  EXPECT_THAT(numbers({{{103.0, 100.0}, 4.0},
                       {{100.0, 105.0}, 4.0},
                       {{100.0, 105.0}, 4.0},
                       {{100.0, 113.0}, 4.0}},
                      all),
              ElementsAre(1U, 2U, 0U))
      << "13 px are beyond 3 deviations";
  EXPECT_THAT(numbers({{{103.0, 100.0}, 4.0},
                       {{100.0, 105.0}, 4.0},
                       {{100.0, 105.0}, 4.0},
                       {{100.0, 123.0}, 4.0}},
                      all, 2.0),
              ElementsAre(1U, 2U, 0U, 3U))
      << "of a painting twice as large";
  EXPECT_THAT(numbers({{{103.0, 100.0}, 4.0},
                       {{100.0, 105.0}, 4.0},
                       {{100.0, 105.0}, 4.0},
                       {{100.0, 105.0}, 4.0}},
                      {true, false, true, false}),
              ElementsAre(2U, 0U))
      << "hidden ones are left out";
  // Far ones of which the view knows nothing: 400 / 40² = 1/4 < 40 / 4².
  EXPECT_THAT(numbers({{{100.0, 100.0}, 4.0},
                       {{100.0, 100.0}, 40.0},
                       {{170.0, 100.0}, 4.0},
                       {{170.0, 100.0}, 400.0}},
                      all),
              ElementsAre(0U, 1U))
      << "nothing is proposed beyond 60 px";
}

TEST(PairProposals, GroundHidesWhatLiesBehindIt) {
  // A wall from west to east, 1500 m higher than the ground on both sides.
  const Dem dem = make_dem(
      {test::grid_of(120, 120,
                     [](int, int y) { return std::abs(y - 50) < 2 ? 2500.0 : 1000.0 - y; }),
       {660000.0, 5280000.0, 400.0, 400.0},
       normalize_crs("EPSG:32632")});
  std::vector<ControlPair> pairs = test::synthetic_places(40);
  const test::SyntheticView truth = test::synthetic_view(ViewKind::plane, pairs);
  test::paint(truth, pairs);
  const Registration found = register_pairs(pairs, {1200, 550});
  const RegisteredView view(found, registered_scene(found, {1200, 550}), dem, {600, 275},
                            silent_progress());
  const double wall = dem.transform.to_crs(0.0, 50.0).y;
  const auto seen = [&](double metres_north, double altitude_m) {
    return is_seen(
        view, {.name = "", .position = {686000.0, wall + metres_north}, .altitude_m = altitude_m});
  };
  EXPECT_TRUE(seen(0.0, 2500.0)) << "the top of the wall";
  EXPECT_FALSE(seen(2000.0, 955.0)) << "behind it";
  EXPECT_TRUE(seen(-4000.0, 940.0)) << "in front of it";
}

constexpr float no_ground = std::numeric_limits<float>::quiet_NaN();

// Sky above row 10, far ground below, near ground below a ridge that rises by a row in two columns.
RegisteredGround two_ranges(int width) {
  RegisteredGround out;
  out.distance_m = test::grid_of(width, 60, [](int x, int y) {
    return y < 10 ? static_cast<double>(no_ground) : y < 50 - x / 2 ? 20000.0 : 8000.0;
  });
  return out;
}

TEST(SeenLines, AreTheSkylineAndTheRidge) {
  const std::vector<SeenLine> lines = seen_lines(two_ranges(40));
  ASSERT_EQ(lines.size(), 2U);
  for (const SeenLine& line : lines) {
    ASSERT_EQ(line.points.size(), 40U);
    for (int x = 0; x < 40; ++x) {
      const glm::vec2 point = line.points[static_cast<std::size_t>(x)];
      EXPECT_EQ(point.x, static_cast<float>(x) + 0.5F);
      EXPECT_EQ(point.y, line.skyline ? 10.F : static_cast<float>(50 - x / 2));
    }
  }
  EXPECT_NE(lines[0].skyline, lines[1].skyline);
}

TEST(SeenLines, SlopesAndShortPiecesAreNone) {
  RegisteredGround slope;
  slope.distance_m = test::grid_of(40, 60, [](int, int y) { return 9000.0 - 100.0 * y; });
  EXPECT_TRUE(seen_lines(slope).empty());
  EXPECT_TRUE(seen_lines(two_ranges(7)).empty());
  EXPECT_EQ(seen_lines(two_ranges(7), {.min_length_px = 7}).size(), 2U);
}

TEST(SeenLines, AStepOfMoreThanItsLimitEndsALineAndBeginsAnother) {
  const auto stepped = [](int rows) {
    RegisteredGround out;
    out.distance_m = test::grid_of(40, 60, [=](int x, int y) {
      return y < (x < 20 ? 10 : 10 + rows) ? static_cast<double>(no_ground) : 5000.0;
    });
    return out;
  };
  const SeenLinesParameters usual;
  EXPECT_EQ(seen_lines(stepped(usual.max_step_px)).size(), 1U);
  const std::vector<SeenLine> lines = seen_lines(stepped(usual.max_step_px + 1));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].points.back().x, 19.5F);
  EXPECT_EQ(lines[1].points.front().x, 20.5F);
}

}  // namespace
}  // namespace belvedere
