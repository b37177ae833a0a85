// Which cells of which tiles an area needs: counted by hand.
#include "terrain/fetch/tile_mosaic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace belvedere {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Tiles of 10 × 10 cells a degree, of 5 × 10 beyond 60°.
MapSource tens() {
  MapSource source;
  source.rows = 10;
  source.columns = {{0.0, 10}, {60.0, 5}};
  source.latitudes = {-80.0, 80.0};
  return source;
}

int cells_of(const std::vector<TileCells>& tiles) {
  int sum = 0;
  for (const TileCells& t : tiles) sum += (t.x1 - t.x0) * (t.y1 - t.y0);
  return sum;
}

TEST(TilePlan, AnAreaHasItsCellsAndSixAroundThem) {
  const std::vector<PartPlan> parts = plan_parts(tens(), {10.25, 46.35, 10.65, 46.65}, 1);
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].x0, 1902 - 6);
  EXPECT_EQ(parts[0].x1, 1907 + 6);
  EXPECT_EQ(parts[0].y0, 433 - 6);
  EXPECT_EQ(parts[0].y1, 437 + 6);
}

TEST(TilePlan, EveryCellOfAPartLiesInOneTile) {
  const MapSource source = tens();
  for (const int step : {1, 3})
    for (const PartPlan& part : plan_parts(source, {10.2, 58.7, 12.7, 61.6}, step)) {
      const std::vector<TileCells> tiles = tiles_of_part(part);
      EXPECT_EQ(cells_of(tiles), (part.x1 - part.x0) * (part.y1 - part.y0)) << "step " << step;
      for (const TileCells& t : tiles)
        for (const int y : {t.y0, t.y1 - 1})
          for (const int x : {t.x0, t.x1 - 1})
            EXPECT_EQ(tile_at(part, x, y), t.tile) << "step " << step;
    }
}

TEST(TilePlan, PartsChangeWhereCellsChangeTheirWidth) {
  const std::vector<PartPlan> parts = plan_parts(tens(), {10.2, 58.7, 12.7, 61.6}, 1);
  ASSERT_THAT(parts, SizeIs(2));
  EXPECT_EQ(parts[0].lattice.columns, 5);
  EXPECT_EQ(parts[1].lattice.columns, 10);
  EXPECT_EQ(parts[0].y1, parts[1].y0) << "rows go on";
  EXPECT_EQ(parts[0].y1, 300) << "at 60°";
}

TEST(TilePlan, CellsOnLinesLieHalfACellFarther) {
  MapSource source = tens();
  source.on_lines = true;
  const PartPlan part = plan_parts(source, {10.2, 46.3, 10.7, 46.6}, 1).front();
  EXPECT_NEAR(part.lattice.transform(0, 0).origin_x, -180.05, 1e-12);
  EXPECT_NEAR(part.lattice.transform(0, 0).origin_y, 90.05, 1e-12);
  // The middle of a cell is a whole tenth of a degree.
  EXPECT_NEAR(part.lattice.transform(part.x0, part.y0).to_crs(0, 0).x * 10.0,
              std::round((part.x0 - 1800.0)), 1e-9);
}

TEST(TilePlan, TilesBeyondTheServiceAreNotAskedFor) {
  EXPECT_THAT(tiles_of(tens(), {0.0, 84.0, 1.0, 85.0}), IsEmpty());
  MapSource whole = tens();
  whole.latitudes = {-90.0, 90.0};
  // Six cells of a fifth of a degree reach into the tiles beside it, six of a tenth into the one
  // below.
  EXPECT_THAT(tiles_of(whole, {0.5, 84.65, 0.52, 84.66}),
              ElementsAre(MapTile{179, 4}, MapTile{180, 4}, MapTile{181, 4}, MapTile{179, 5},
                          MapTile{180, 5}, MapTile{181, 5}));
}

}  // namespace
}  // namespace belvedere
