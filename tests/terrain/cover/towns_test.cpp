#include "terrain/cover/towns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "terrain/shape/derivatives.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

// A valley floor 3 km wide from west to east between slopes, a river along it, and a side valley
// that opens at `mouth_m` east of the centre.
struct Valley {
  static constexpr int width = 700;
  static constexpr int height = 240;
  static constexpr double cell_m = 30.0;
  Grid<float> altitude_m{width, height};
  Grid<float> floor{width, height, 0.F};
  Grid<float> catchment_km2{width, height, 0.1F};
  Grid<float> slope{width, height, 0.F};
  Grid<float> south{width, height, 0.F};
  GeoTransform transform{0.0, height* cell_m, cell_m, cell_m};

  explicit Valley(int mouth_column = 350) {
    for (const auto [x, y] : test::cells(width, height)) {
      const double aside = std::abs(y - height / 2) * cell_m;
      altitude_m(x, y) = static_cast<float>(600.0 + 0.45 * std::max(0.0, aside - 1500.0));
      floor(x, y) = aside < 1500.0 ? 1.F : 0.F;
      slope(x, y) = aside < 1500.0 ? 0.F : 24.F;
    }
    for (int x = 0; x < width; ++x)
      catchment_km2(x, height / 2) = 600.F + 0.01F * static_cast<float>(x);
    for (int y = 0; y < height / 2; ++y)
      catchment_km2(mouth_column, y) = 100.F + static_cast<float>(y);
  }
  TownGround ground() const { return {altitude_m, floor, catchment_km2, slope, south, transform}; }
};

TEST(Towns, StandOnTheFloorBesideTheRiverNotInIt) {
  const Valley valley;
  TownParameters p;
  p.seed = 4;
  const std::vector<TownSite> sites = find_town_sites(valley.ground(), p);
  ASSERT_GT(sites.size(), 4U);
  int near_river = 0;
  for (const TownSite& site : sites) {
    const glm::dvec2 at = valley.transform.to_cell(site.position.x, site.position.y);
    EXPECT_TRUE(site.on_floor);
    EXPECT_EQ(
        valley.floor(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))),
        1.F);
    const double away = std::abs(at.y - Valley::height / 2) * Valley::cell_m;
    EXPECT_GT(away, 125.0);
    near_river += away < 900.0 ? 1 : 0;
    // Where no side valley opens, streets run along the main one.
    if (std::abs(at.x - 350.0) * Valley::cell_m > 1500.0) {
      EXPECT_LT(std::abs(std::sin(site.along_rad)), 0.5);
    }
  }
  EXPECT_GT(near_river, static_cast<int>(sites.size()) * 2 / 5) << "of " << sites.size();
}

TEST(Towns, TheLargestStandsWhereASideValleyOpens) {
  for (const int mouth : {150, 350, 550}) {
    const Valley valley(mouth);
    TownParameters p;
    p.seed = 4;
    const std::vector<TownSite> sites = find_town_sites(valley.ground(), p);
    const TownSite& first = sites.front();
    const glm::dvec2 opening = valley.transform.to_crs(mouth, Valley::height / 2 - 50);
    EXPECT_LT(glm::length(first.position - opening), 1200.0) << mouth;
    for (const TownSite& site : sites) EXPECT_LE(site.radius_m, first.radius_m + 150.0);
  }
}

TEST(Towns, KeepADistanceAndDifferInSize) {
  const Valley valley;
  TownParameters p;
  p.seed = 4;
  const std::vector<TownSite> sites = find_town_sites(valley.ground(), p);
  double smallest = 1e9;
  double largest = 0.0;
  for (std::size_t a = 0; a < sites.size(); ++a) {
    smallest = std::min(smallest, sites[a].radius_m);
    largest = std::max(largest, sites[a].radius_m);
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT(glm::length(sites[a].position - sites[b].position), 1000.0);
  }
  EXPECT_GT(largest, 2.5 * smallest);
}

TEST(Towns, AmountRaisesWhatIsBuiltAndNothingIsHigherThanAsked) {
  const Valley valley;
  const auto built_km2 = [&](double amount, double highest_m) {
    TownParameters p;
    p.amount = amount;
    p.highest_m = highest_m;
    double sum = 0.0;
    for (const TownSite& site : find_town_sites(valley.ground(), p))
      sum += 3.14159e-6 * site.radius_m * site.radius_m * site.stretch;
    return sum;
  };
  EXPECT_EQ(built_km2(-1.0, 1300.0), 0.0);
  EXPECT_LT(1.2 * built_km2(-0.5, 1300.0), built_km2(0.0, 1300.0));
  EXPECT_LT(1.2 * built_km2(0.0, 1300.0), built_km2(0.9, 1300.0));
  EXPECT_EQ(built_km2(0.5, 590.0), 0.0);
}

// Unbounded level ground, with a river of 600 km² through its centre from west to east.
struct Plain {
  static constexpr int side = 700;
  static constexpr double cell_m = 30.0;
  Grid<float> altitude_m{side, side, 400.F};
  Grid<float> floor{side, side, 1.F};
  Grid<float> catchment_km2{side, side, 0.1F};
  Grid<float> slope{side, side, 0.F};
  Grid<float> south{side, side, 0.F};
  GeoTransform transform{0.0, side* cell_m, cell_m, cell_m};

  Plain() {
    for (int x = 0; x < side; ++x)
      catchment_km2(x, side / 2) = 600.F + 0.01F * static_cast<float>(x);
  }
  TownGround ground() const { return {altitude_m, floor, catchment_km2, slope, south, transform}; }
};

// A plain of 21 × 21 km could hold a hundred and fifty villages at their minimum distance.
TEST(Towns, PlainsAreNotFilledButWhereRiversAre) {
  const Plain plain;
  const std::vector<TownSite> sites = find_town_sites(plain.ground(), {});
  EXPECT_GE(sites.size(), 3U);
  EXPECT_LE(sites.size(), 14U);
  for (const TownSite& site : sites) {
    const double from_river =
        std::abs(plain.transform.to_cell(site.position.x, site.position.y).y - Plain::side / 2) *
        Plain::cell_m;
    const double from_edge =
        std::min({site.position.x, site.position.y, Plain::side * Plain::cell_m - site.position.x,
                  Plain::side * Plain::cell_m - site.position.y});
    EXPECT_LT(std::min(from_river, from_edge), 1500.0);
  }
  // As in the Alps: everywhere, and larger.
  TownParameters alpine;
  alpine.inferred = 1.0;
  EXPECT_GT(find_town_sites(plain.ground(), alpine).size(), 60U);
  const auto built_m2 = [](const std::vector<TownSite>& all) {
    double sum = 0.0;
    for (const TownSite& site : all) sum += site.radius_m * site.radius_m * site.stretch;
    return sum;
  };
  const Valley valley;
  EXPECT_GT(find_town_sites(valley.ground(), alpine).size(),
            find_town_sites(valley.ground(), {}).size());
  EXPECT_GT(built_m2(find_town_sites(valley.ground(), alpine)),
            1.5 * built_m2(find_town_sites(valley.ground(), {})));
}

TEST(Towns, NobodyIsGuessedWhereTheLandFeedsNobody) {
  const Valley valley;
  TownGround ground = valley.ground();
  const Grid<float> none(Valley::width, Valley::height, 0.F);
  const Grid<float> all(Valley::width, Valley::height, 1.F);
  Grid<float> east = none;
  for (const auto [x, y] : test::cells({350, 0, Valley::width, Valley::height})) east(x, y) = 1.F;
  TownParameters p;
  p.known = {{{3000.0, 3300.0}, 700.0}};
  const auto sites_with = [&](const Grid<float>* suitability) {
    ground.suitability = suitability;
    return find_town_sites(ground, p);
  };
  // Known towns stay.
  ASSERT_EQ(sites_with(&none).size(), 1U);
  EXPECT_EQ(sites_with(&none)[0].position, glm::dvec2(3000.0, 3300.0));
  EXPECT_EQ(sites_with(&all).size(), sites_with(nullptr).size());
  const std::vector<TownSite> half = sites_with(&east);
  EXPECT_GT(half.size(), 2U);
  for (std::size_t i = 1; i < half.size(); ++i) EXPECT_GE(half[i].position.x, 350 * Valley::cell_m);
}

// For real climates: Innsbruck, Seattle, Kiruna's mountains, Death Valley, the steppe of Mongolia.
TEST(Towns, LandFeedsPeopleByWaterAndWarmth) {
  EXPECT_EQ(agricultural_suitability(1.F, 9.F), 1.F);
  EXPECT_EQ(agricultural_suitability(0.8F, 11.F), 1.F);
  EXPECT_EQ(agricultural_suitability(1.F, -3.F), 0.F);
  EXPECT_EQ(agricultural_suitability(0.05F, 25.F), 0.F);
  EXPECT_EQ(agricultural_suitability(0.35F, 0.F), 0.F);
  float before = 0.F;
  for (float moisture = 0.F; moisture <= 1.F; moisture += 0.01F) {
    EXPECT_GE(agricultural_suitability(moisture, 8.F), before);
    before = agricultural_suitability(moisture, 8.F);
  }
}

// A terrace far from any floor, in the hills, has no hamlet; one above a valley has.
TEST(Towns, HamletsHaveAFloorWithinReach) {
  Valley valley;
  for (const auto [x, y] : test::cells(Valley::width, Valley::height)) {
    valley.slope(x, y) = valley.floor(x, y) > 0.5F ? 0.F : 5.F;
    valley.south(x, y) = 1.F;
  }
  const auto hamlets = [&] {
    int count = 0;
    for (const TownSite& site : find_town_sites(valley.ground(), {}))
      count += site.on_floor ? 0 : 1;
    return count;
  };
  EXPECT_GT(hamlets(), 0);
  for (float& f : valley.floor) f = 0.F;
  EXPECT_EQ(hamlets(), 0);
}

TEST(Towns, KnownOnesComeFirstAndKeepOthersAway) {
  const Valley valley;
  TownParameters p;
  p.known = {{{9000.0, 3300.0}, 1200.0}, {{0.0, 0.0}, 0.0}};
  const std::vector<TownSite> sites = find_town_sites(valley.ground(), p);
  EXPECT_EQ(sites.front().position, glm::dvec2(9000.0, 3300.0));
  // As large as a circle of that radius.
  EXPECT_NEAR(sites.front().radius_m * sites.front().radius_m * sites.front().stretch,
              1200.0 * 1200.0, 1.0);
  for (std::size_t k = 1; k < sites.size(); ++k)
    EXPECT_GT(glm::length(sites[k].position - sites[0].position), 1900.0);
}

TEST(Towns, FieldIsOneInTheMiddleAndZeroAtTheEdge) {
  const Valley valley;
  const TownSite site{valley.transform.to_crs(300, 100), 600.0, 2.0, 0.0, true};
  const Grid<float> field = town_field({site}, valley.ground());
  EXPECT_FLOAT_EQ(field(300, 100), 1.F);
  EXPECT_NEAR(field(300, 120), 0.F, 1e-5F);  // 600 m across
  EXPECT_NEAR(field(340, 100), 0.F, 1e-5F);  // 1200 m along
  EXPECT_FLOAT_EQ(field(300, 239), -4.F);
}

TEST(Towns, ReachOutAlongTheWayToTheirNeighbours) {
  const Valley valley;
  const TownSite west{valley.transform.to_crs(250, 100), 400.0, 1.0, 0.0, true};
  const TownSite east{valley.transform.to_crs(400, 100), 400.0, 1.0, 0.0, true};
  const Grid<float> alone = town_field({west}, valley.ground());
  const Grid<float> linked = town_field({west, east}, valley.ground());
  EXPECT_LT(alone(270, 100), 0.F);
  EXPECT_GT(linked(270, 100), 0.05F) << "on the way";
  EXPECT_LT(linked(270, 106), 0.F) << "beside it";
  EXPECT_LT(linked(325, 100), 0.F) << "open country half way";
  EXPECT_LT(linked(230, 100), 0.F) << "the other side";
}

TEST(Towns, ThreadsChangeNothing) {
  const Valley valley;
  const auto many = town_field(find_town_sites(valley.ground(), {}), valley.ground());
  const ThreadLimit one(1);
  EXPECT_EQ(town_field(find_town_sites(valley.ground(), {}), valley.ground()), many);
}

using test::Notes;
using test::usage_error;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(TownFile, RadiusIsThatOfACircleOf170SquareMetresAHead) {
  EXPECT_NEAR(town_radius_m(100000.0), 2326.2, 0.1);
  EXPECT_DOUBLE_EQ(town_radius_m(40000.0), 2.0 * town_radius_m(10000.0));
  EXPECT_EQ(town_radius_m(0.0), 0.0);
  // Towns that the Karwendel scene has by radius have about this size.
  EXPECT_NEAR(town_radius_m(132000.0), 2600.0, 200.0);  // Innsbruck
  EXPECT_NEAR(town_radius_m(14000.0), 950.0, 100.0);    // Schwaz
}

TEST(TownFile, RadiusHasTheLastWordAndRowsWithoutSizeAreNoted) {
  const test::Folder folder;
  Notes notes;
  const std::vector<KnownTown> towns =
      read_towns(folder.write("t.csv",
                              "name,east,north,population,radius_m\nA,1,2,10000,\nB,3,4,10000,"
                              "700\nC,5,6,,\nD,7,8,0,\n"),
                 "", notes);
  ASSERT_EQ(towns.size(), 2U);
  EXPECT_EQ(towns[0].name, "A");
  EXPECT_EQ(towns[0].position, glm::dvec2(1.0, 2.0));
  EXPECT_EQ(towns[0].radius_m, town_radius_m(10000.0));
  EXPECT_EQ(towns[1].radius_m, 700.0);
  EXPECT_THAT(notes.all, ElementsAre(HasSubstr("2 of 4 towns")));
  // A file without names also works.
  EXPECT_EQ(
      read_towns(folder.write("u.csv", "east,north,radius_m\n1,2,300\n"), "", notes).at(0).name,
      "");
}

TEST(TownFile, RefusesWhatIsNoSize) {
  const test::Folder folder;
  const auto refused = [&](const std::string& text) {
    const std::string file = folder.write("t.csv", text);
    return usage_error([&] { read_towns(file, "", silent_progress()); });
  };
  EXPECT_THAT(refused("name,east,north,size\nA,1,2,3\n"),
              AllOf(HasSubstr("name, east, north, size"), HasSubstr("radius_m or population")));
  EXPECT_THAT(refused("east,north,radius_m\n1,2,large\n"),
              AllOf(HasSubstr("t.csv:2"), HasSubstr("radius_m is \"large\"")));
  EXPECT_THAT(refused("east,north,population\n1,2,-5\n"), HasSubstr("0 …"));
  EXPECT_THAT(refused("east,north,radius_m\n1,2,60000\n"), HasSubstr("at most 50000 m"));
}

}  // namespace
}  // namespace belvedere
