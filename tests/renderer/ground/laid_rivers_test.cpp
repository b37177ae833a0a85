#include "renderer/ground/laid_rivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "renderer/world/scene_land_cover.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr int valley_cells = 120;
constexpr double valley_cell_m = 100.0;

// A valley that falls to the south along x = 6 km.
Dem make_valley() {
  Dem dem;
  dem.altitude_m = Grid<float>(valley_cells, valley_cells);
  dem.filled = Grid<std::uint8_t>(valley_cells, valley_cells);
  dem.transform = {0.0, valley_cells * valley_cell_m, valley_cell_m, valley_cell_m};
  for (const auto [x, y] : test::cells(valley_cells, valley_cells))
    dem.altitude_m(x, y) =
        900.0F - 1.2F * static_cast<float>(y) + 6.0F * std::abs(static_cast<float>(x) - 59.5F);
  return dem;
}

MapRivers one_river() {
  MapRivers rivers;
  rivers.lines.push_back({.positions = {{6300.0, 11800.0}, {6200.0, 6000.0}, {6300.0, 300.0}},
                          .width_m = 0.0,
                          .min_width_m = 20.0,
                          .snap_m = 800.0,
                          .group = 1});
  rivers.looks.resize(2);
  rivers.looks[1].painted_as = LandCoverClass::water;
  rivers.looks[1].rank = 7.0F;
  return rivers;
}

std::unique_ptr<Camera> camera_at(double altitude_m) {
  const CameraParameters p{
      .width = 1000, .height = 1000, .eye = {6000.0, 6000.0, altitude_m}, .pitch_deg = -90.0};
  return make_camera(p);
}

class LaidRivers : public testing::Test {
 protected:
  std::vector<CoverRiver> laid(double min_px, const Camera* camera = nullptr,
                               const Cache& cache = no_cache()) const {
    std::vector<CoverRiver> rivers =
        lay_rivers(one_river(), scene_, valley_, silent_progress(), cache);
    const Deformation flat;
    for (CoverRiver& river : rivers)
      if (camera != nullptr)
        river = widen_for_view(river, {.min_px = min_px}, valley_, {*camera, flat});
    return rivers;
  }
  test::Folder folder_;
  Dem valley_ = make_valley();
  LoadedScene scene_ = parse_scene("version = 1\n", "mine.toml", folder_.path(), {});
};

float widest(const std::vector<CoverRiver>& centrelines) {
  return *std::max_element(centrelines[0].half_width_m.begin(), centrelines[0].half_width_m.end());
}

TEST_F(LaidRivers, RunAlongTheBottomOfTheirValley) {
  const std::vector<CoverRiver> centrelines = laid(0.0);
  ASSERT_EQ(centrelines.size(), 1U);
  EXPECT_EQ(centrelines[0].painted_as, LandCoverClass::water);
  EXPECT_EQ(centrelines[0].rank, 7.0F);
  for (const glm::dvec2 position : centrelines[0].positions) {
    if (position.y < 1500.0 || position.y > 10500.0) continue;
    EXPECT_NEAR(position.x, 6000.0, valley_cell_m) << position.y;
  }
}

TEST_F(LaidRivers, AreWidenedWhereTheyWouldBreakIntoDotsAndUpToThreeTimes) {
  const float own = widest(laid(2.0));
  // Straight down with 50° over 1000 pixels: a pixel covers .93 m per km of height.
  EXPECT_EQ(widest(laid(2.0, camera_at(3000.0).get())), own) << "some ten pixels wide as it is";
  const auto far = camera_at(60000.0);
  EXPECT_NEAR(widest(laid(0.75 * 2.0F * own / 55.2, far.get())), own, 0.01F)
      << "the minimum is below its own width";
  EXPECT_NEAR(widest(laid(2.0 * 2.0 * own / 55.2, far.get())), 2.0F * own, 0.06F * own);
  EXPECT_NEAR(widest(laid(50.0, far.get())), 3.0F * own, 0.01F);
}

TEST_F(LaidRivers, InferredOnesFadeBeforeTheyBreakIntoDots) {
  CoverRiver brook;
  for (int y = 0; y < 100; ++y)
    brook.positions.emplace_back(6000.0, 9000.0 - 50.0 * y), brook.half_width_m.push_back(10.F);
  const Deformation flat;
  const auto far = camera_at(60000.0);
  // 55 m per pixel.
  const auto half_m = [&](double min_px, bool fades) {
    const CoverRiver drawn = widen_for_view(brook, {min_px, fades}, valley_, {*far, flat});
    return *std::max_element(drawn.half_width_m.begin(), drawn.half_width_m.end());
  };
  EXPECT_NEAR(half_m(0.2, true), 10.F, 0.01F);
  EXPECT_NEAR(half_m(0.72, true), 20.F, 0.5F);
  EXPECT_NEAR(half_m(1.2, true), 30.F, 0.1F) << "nearly as wide as it should be";
  EXPECT_EQ(half_m(5.0, true), 0.F);
  EXPECT_NEAR(half_m(5.0, false), 30.F, 0.1F) << "a map's stays";
}

TEST_F(LaidRivers, InferredOnesAreWiderBelowTheirTributariesAlsoFromAfar) {
  const Deformation flat;
  const auto far = camera_at(60000.0);
  const auto half_m = [&](float own_m, bool fades) {
    CoverRiver river;
    for (int y = 0; y < 100; ++y)
      river.positions.emplace_back(6000.0, 9000.0 - 50.0 * y), river.half_width_m.push_back(own_m);
    const CoverRiver drawn =
        widen_for_view(river, {.min_px = 1.5, .fades = fades}, valley_, {*far, flat});
    return *std::max_element(drawn.half_width_m.begin(), drawn.half_width_m.end());
  };
  // 41 m in each direction are min_px.
  EXPECT_GT(half_m(40.F, true), 1.3F * half_m(20.F, true));
  EXPECT_NEAR(half_m(40.F, false), half_m(20.F, false), 0.1F)
      << "a map gives the sizes of its rivers";
}

TEST_F(LaidRivers, AreTheSameFromTheCache) {
  const Cache cache({.folder = folder_ / "cache", .limit_bytes = 0});
  const std::vector<CoverRiver> first = laid(0.0, nullptr, cache);
  const std::vector<CoverRiver> again = laid(0.0, nullptr, cache);
  ASSERT_EQ(first.size(), again.size());
  EXPECT_EQ(first[0].positions, again[0].positions);
  EXPECT_EQ(first[0].half_width_m, again[0].half_width_m);
  EXPECT_EQ(first[0].positions, laid(0.0)[0].positions);
}

using enum LandCoverClass;

// A valley of 100 km² down column 50 whose eastern half is forest in the raster, and grass in the
// west.
TEST(RefinedRivers, RunWhereTheirClassMayBecomeWater) {
  const test::Folder folder;
  folder.write("rules.toml",
               "version = 1\nname = \"wet\"\nrivers = \"1\"\n[parameters]\nspeck_cells = "
               "0\n[[layers]]\nclass = \"pasture\"\nwhen = \"1\"\n");
  const GeoTransform transform{500000.0, 5200000.0, 100.0, 100.0};
  Dem valley = make_dem({Grid<float>(101, 101), transform, normalize_crs("EPSG:32632")});
  Raster<float> codes{Grid<float>(101, 101), transform, valley.crs};
  for (const auto [x, y] : test::cells(101, 101)) {
    valley.altitude_m(x, y) =
        900.F - 2.F * static_cast<float>(y) + 20.F * std::abs(static_cast<float>(x - 50));
    codes.cells(x, y) = y < 60 ? 30.F : 10.F;
  }
  write_raster(folder / "cover.tif", codes);
  const auto water_at = [&](const std::string& refine, int row) {
    const LoadedScene scene = parse_scene(
        "version = 1\n[land_cover]\nlegend = \"esa_worldcover\"\nrules = \"rules.toml\"\n" +
            refine + "[[land_cover.sources]]\nfile = \"cover.tif\"\n",
        "s.toml", folder.path(), {});
    const LandCover cover = make_scene_land_cover(scene, valley, silent_progress());
    const glm::dvec2 position = transform.to_crs(50, row);
    return cover.at(position.x, position.y) == water;
  };
  EXPECT_TRUE(water_at("refine = { water = \"pasture\" }\n", 55));
  EXPECT_FALSE(water_at("refine = { water = \"pasture\" }\n", 90)) << "forest there";
  EXPECT_TRUE(water_at("refine = { water = \"forest\" }\n", 90));
  EXPECT_FALSE(water_at("refine = { snow = \"pasture\" }\n", 55));
  EXPECT_FALSE(water_at("", 55)) << "the raster alone decides";
}

constexpr float river_half_m = 25.0F;

CoverRiver course(const std::function<glm::dvec2(double)>& way, double length_m) {
  CoverRiver river;
  river.rank = 7.0;
  for (double s = 0.0; s <= length_m; s += 45.0) {
    river.positions.push_back(way(s));
    river.half_width_m.push_back(river_half_m);
  }
  return river;
}
CoverRiver straight_course() {
  return course([](double s) { return glm::dvec2(s, 0.0); }, 90000.0);
}

std::vector<CoverRiver> shores_of(
    const CoverRiver& river, double units_per_m,
    const std::function<bool(glm::dvec2)>& is_open = [](glm::dvec2) { return true; },
    const std::function<bool(glm::dvec2)>& grows_trees = [](glm::dvec2) { return true; }) {
  const std::vector<CoverRiver> rivers = {river};
  return river_shores(
      rivers,
      {.units_per_m =
           [&](std::size_t) { return std::vector<double>(river.positions.size(), units_per_m); },
       .is_open = is_open,
       .grows_trees = grows_trees});
}

// Mean half width of strips of a class among positions chosen, over all positions of the river.
double mean_half_m(
    const std::vector<CoverRiver>& shores, LandCoverClass id, std::size_t count,
    const std::function<bool(glm::dvec2)>& chosen = [](glm::dvec2) { return true; }) {
  double sum = 0.0;
  for (const CoverRiver& strip : shores)
    for (std::size_t i = 0; i < strip.positions.size(); ++i)
      if (strip.painted_as == id && chosen(strip.positions[i]))
        sum += static_cast<double>(strip.half_width_m[i]);
  return sum / static_cast<double>(count);
}

TEST(RiverShores, HaveGapsAndLeaveTheWaterFree) {
  const CoverRiver river = straight_course();
  const std::vector<CoverRiver> shores = shores_of(river, 0.2);
  ASSERT_GT(shores.size(), 40U);
  for (const CoverRiver& strip : shores) {
    EXPECT_EQ(strip.kind, shore_kind);
    EXPECT_EQ(strip.rank, 7.0);
    ASSERT_EQ(strip.positions.size(), strip.half_width_m.size());
    for (std::size_t i = 0; i < strip.positions.size(); ++i) {
      const double off = std::abs(strip.positions[i].y);
      const double half = static_cast<double>(strip.half_width_m[i]);
      if (half == 0.0) continue;
      // Gravel begins at the bank; trees stand beyond it.
      if (strip.painted_as == LandCoverClass::sand) {
        EXPECT_NEAR(off, 25.0, 1e-6);
      } else {
        EXPECT_GE(off - half, 25.0 - 1e-3);
      }
    }
  }
  // No more than a third of the banks has trees.
  std::size_t grown = 0;
  for (const CoverRiver& strip : shores)
    if (strip.painted_as == LandCoverClass::forest)
      grown += static_cast<std::size_t>(std::count_if(strip.half_width_m.begin(),
                                                      strip.half_width_m.end(),
                                                      [](float half) { return half > 2.F; }));
  const double share =
      static_cast<double>(grown) / (2.0 * static_cast<double>(river.positions.size()));
  EXPECT_GT(share, 0.12);
  EXPECT_LT(share, 0.40);
}

// On a circle that turns left the inner bank is the left one.
TEST(RiverShores, GravelLiesInsideOfBendsAndTreesOutside) {
  constexpr double radius_m = 200.0;
  const auto circle = [&](double s) {
    return radius_m * glm::dvec2(std::cos(s / radius_m), std::sin(s / radius_m));
  };
  double gravel_in = 0.0;
  double gravel_out = 0.0;
  double trees_in = 0.0;
  double trees_out = 0.0;
  for (int k = 0; k < 40; ++k) {
    const glm::dvec2 middle(5000.0 * k, 0.0);
    const CoverRiver river = course([&](double s) { return middle + circle(s); }, 1100.0);
    const std::vector<CoverRiver> shores = shores_of(river, 0.2);
    const auto inside = [&](glm::dvec2 at) { return std::hypot(at.x - middle.x, at.y) < radius_m; };
    const auto outside = [&](glm::dvec2 at) { return !inside(at); };
    const std::size_t n = river.positions.size();
    gravel_in += mean_half_m(shores, LandCoverClass::sand, n, inside) / 40.0;
    gravel_out += mean_half_m(shores, LandCoverClass::sand, n, outside) / 40.0;
    trees_in += mean_half_m(shores, LandCoverClass::forest, n, inside) / 40.0;
    trees_out += mean_half_m(shores, LandCoverClass::forest, n, outside) / 40.0;
  }
  EXPECT_GT(gravel_in, 2.5 * gravel_out);
  EXPECT_GT(trees_out, 2.0 * trees_in);
}

TEST(RiverShores, NarrowAndUnseenRiversHaveNone) {
  EXPECT_TRUE(shores_of(straight_course(), 0.02).empty());
  EXPECT_TRUE(shores_of(straight_course(), 0.0).empty());
}

TEST(RiverShores, OnlyOpenGroundHasThem) {
  const std::vector<CoverRiver> shores =
      shores_of(straight_course(), 0.2, [](glm::dvec2 at) { return at.y > 0.0; });
  ASSERT_FALSE(shores.empty());
  for (const CoverRiver& strip : shores)
    for (std::size_t i = 0; i < strip.positions.size(); ++i)
      EXPECT_TRUE(strip.positions[i].y > 0.0 || strip.half_width_m[i] == 0.F);
}

// Above the treeline gravel alone lies on the banks.
TEST(RiverShores, TreesStandWhereTheyGrow) {
  const std::vector<CoverRiver> shores = shores_of(
      straight_course(), 0.2, [](glm::dvec2) { return true; },
      [](glm::dvec2 at) { return at.x < 45000.0; });
  double trees[2] = {0.0, 0.0};
  double gravel[2] = {0.0, 0.0};
  for (const CoverRiver& strip : shores)
    for (std::size_t i = 0; i < strip.positions.size(); ++i)
      (strip.painted_as == LandCoverClass::forest
           ? trees
           : gravel)[strip.positions[i].x < 45000.0 ? 0 : 1] +=
          static_cast<double>(strip.half_width_m[i]);
  EXPECT_GT(trees[0], 0.0);
  EXPECT_EQ(trees[1], 0.0);
  EXPECT_GT(gravel[1], 0.5 * gravel[0]);
}

// Breadths are limited in units of the sheet: of a river twice as large on it they are not twice as
// broad there.
TEST(RiverShores, StayNarrowOnTheSheet) {
  const CoverRiver river = straight_course();
  for (const CoverRiver& strip : shores_of(river, 4.0))
    for (const float half : strip.half_width_m) EXPECT_LE(half * 4.0F, 3.4F + 1e-3F);
}

}  // namespace
}  // namespace belvedere
