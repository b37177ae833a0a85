#include "renderer/trace/traced_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "terrain/deform/deform.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// 5 × 4 posts one metre apart, rows to the south, on the plane z = x / 2.
struct Slope {
  Slope() {
    surface.vertices_m = Grid<glm::vec3>(5, 4);
    for (const auto [x, y] : test::cells(5, 4))
      surface.vertices_m(x, y) = {static_cast<float>(x), -static_cast<float>(y),
                                  0.5F * static_cast<float>(x)};
    parts = make_traced_parts(surface, 64);
  }
  bool down_at(double x, double y, glm::vec2 in_tile, Hit& hit) const {
    return resolve_facet(parts[0], parts[0].tiles[0], in_tile, {{x, -y, 10.0}, {0.0, 0.0, -1.0}},
                         hit);
  }

  DeformedSurface surface;
  std::vector<TracedPart> parts;
};

TEST(FacetHit, PlaceDistanceAndNormalAreThoseOfThePlane) {
  const Slope slope;
  Hit hit;
  ASSERT_TRUE(slope.down_at(2.25, 1.5, {2.25F / 4.F, 1.5F / 3.F}, hit));
  EXPECT_TRUE(hit.found);
  EXPECT_NEAR(hit.column, 2.25, 1e-12);
  EXPECT_NEAR(hit.row, 1.5, 1e-12);
  EXPECT_NEAR(hit.distance_m, 10.0 - 1.125, 1e-12);
  EXPECT_NEAR(hit.facet_normal().x, -1.0 / std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(hit.facet_normal().z, 2.0 / std::sqrt(5.0), 1e-12);
}

TEST(FacetHit, AFacetNamedWronglyGivesWayToItsNeighbour) {
  const Slope slope;
  Hit hit;
  // The ray hits the cell east of the given one.
  ASSERT_TRUE(slope.down_at(2.0001, 1.4, {1.9999F / 4.F, 1.4F / 3.F}, hit));
  EXPECT_NEAR(hit.column, 2.0001, 1e-12);
  EXPECT_NEAR(hit.distance_m, 10.0 - 0.5 * 2.0001, 1e-12);
}

TEST(FacetHit, ARayBesideTheGroundPassesIt) {
  const Slope slope;
  Hit hit;
  EXPECT_FALSE(slope.down_at(4.001, 1.4, {0.9999F, 1.4F / 3.F}, hit));
  EXPECT_FALSE(hit.found);
}

TEST(TracedPart, TilesCoverEachCellOnce) {
  const Slope slope;
  for (const int side : {1, 2, 3, 64}) {
    Grid<int> seen(4, 3, 0);
    const std::vector<TracedPart> parts = make_traced_parts(slope.surface, side);
    for (const GridTile& tile : parts[0].tiles) {
      EXPECT_LE(std::max(tile.cells_x, tile.cells_y), side);
      for (const auto [x, y] :
           test::cells({tile.x0, tile.y0, tile.x0 + tile.cells_x, tile.y0 + tile.cells_y}))
        ++seen(x, y);
    }
    EXPECT_EQ(seen, Grid<int>(4, 3, 1));
  }
}

}  // namespace
}  // namespace belvedere
