#include "renderer/trace/terrain_rim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/paint/terrain_end.h"

namespace belvedere {
namespace {

constexpr double rim_cell_m = 90.0;
constexpr int rim_posts = 300;
constexpr double rim_side_m = rim_posts * rim_cell_m;
constexpr double fade_of_side = 0.03;

// Hills of a few hundred metres and, by the northern edge, one mountain of `height_m`, `summit`
// rows from it.
Dem hills_with_mountain(double height_m, int summit) {
  Raster<float> raster;
  raster.transform = {460000.0, 3110000.0, rim_cell_m, rim_cell_m};
  raster.cells = Grid<float>(rim_posts, rim_posts);
  for (int y = 0; y < rim_posts; ++y)
    for (int x = 0; x < rim_posts; ++x) {
      const double hills = 200.0 * std::sin(0.11 * x + 0.05 * y);
      const double off_m = rim_cell_m * std::hypot(x - 150, y - summit);
      raster.cells(x, y) =
          static_cast<float>(4500.0 + hills + height_m * std::exp(-off_m / 1500.0));
    }
  return make_dem(std::move(raster));
}

// Share of a position's colour that the end of the terrain leaves.
float kept_of(float rim_m, double fade_m) {
  const TerrainEnd end = terrain_end_at(rim_m, fade_m, 0.0F);
  return (1.0F - end.air) * (1.0F - end.dissolved);
}

TEST(TerrainRim, IsTheDistanceToTheEdgeWhereNothingStandsOut) {
  const Dem dem = hills_with_mountain(0.0, 10);
  const Grid<float> rim = rim_distance(dem);
  for (int y = 0; y < rim_posts; ++y)
    for (int x = 0; x < rim_posts; ++x) {
      const int last = rim_posts - 1;
      ASSERT_NEAR(rim(x, y), rim_cell_m * std::min(std::min(x, last - x), std::min(y, last - y)),
                  0.01)
          << x << ' ' << y;
    }
}

TEST(TerrainRim, ATallMountainAtTheEdgeKeepsItsColour) {
  const double fade_m = fade_of_side * rim_side_m;
  for (const int summit : {2, 6, 12, 40}) {
    const Dem dem = hills_with_mountain(3000.0, summit);
    const Grid<float> rim = rim_distance(dem);
    EXPECT_GE(kept_of(rim(150, summit), fade_m), 0.75F) << summit << " rows from the edge";
    EXPECT_LT(kept_of(rim(20, 1), fade_m), 0.2F) << "far from it ground still fades";
  }
}

// Lines of sight to the north, straight and aslant: what lies farther is never clearer.
TEST(TerrainRim, NoGroundFadesMoreThanGroundBehindIt) {
  const double fade_m = fade_of_side * rim_side_m;
  for (const int summit : {2, 12, 40}) {
    const Grid<float> rim = rim_distance(hills_with_mountain(3000.0, summit));
    for (const double aslant : {-0.9, -0.4, 0.0, 0.4, 0.9})
      for (int from = 100; from < 200; from += 3) {
        float nearer = 1.0F;
        for (int step = 0; step < 100; ++step) {
          const int x = from + static_cast<int>(std::lround(aslant * step));
          const int y = 100 - step;
          if (!rim.contains(x, y)) break;
          const float kept = kept_of(rim(x, y), fade_m);
          ASSERT_LE(kept, nearer + 0.03F) << x << ' ' << y << ", summit in row " << summit;
          nearer = std::min(nearer, kept);
        }
      }
  }
}

}  // namespace
}  // namespace belvedere
