#include "terrain/register/highest_cells.h"

#include <gtest/gtest.h>

#include "terrain/io/raster_io.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

TEST(HighestCells, KeepSummits) {
  Dem dem = make_dem({test::grid_of(7, 6, [](int x, int y) { return x == 3 && y == 2 ? 900 : x; }),
                      {0.0, 600.0, 100.0, 100.0},
                      normalize_crs("EPSG:32632")});
  EXPECT_EQ(highest_cells(dem, 42).width(), 7) << "they fit";
  const Dem made = highest_cells(dem, 12);
  EXPECT_EQ(made.width(), 3) << "a column is left over";
  EXPECT_EQ(made.height(), 3);
  EXPECT_EQ(made.cell_m(), 200.0);
  EXPECT_EQ(made.altitude_m(1, 1), 900.F);
  EXPECT_EQ(made.altitude_m(2, 0), 5.F);
  EXPECT_EQ(made.transform.to_crs(0.0, 0.0), glm::dvec2(100.0, 500.0));
  dem.filled = Grid<std::uint8_t>(7, 6);
  dem.filled(0, 0) = 1;
  EXPECT_EQ(highest_cells(dem, 12).filled(0, 0), 0) << "only in part";
  dem.filled(1, 0) = dem.filled(0, 1) = dem.filled(1, 1) = 1;
  EXPECT_EQ(highest_cells(dem, 12).filled(0, 0), 1);
}

}  // namespace
}  // namespace belvedere
