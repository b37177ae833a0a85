#include "terrain/shape/surroundings.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

// A plane of 90 m cells, and a window of 30 m cells in it whose ground is 1000 m higher, so that
// the two can be distinguished.
double plane(glm::dvec2 position) { return 0.1 * position.x - 0.03 * position.y; }
Dem whole_plane() {
  Dem dem;
  dem.transform = {50000.0, 90000.0, 90.0, 90.0};
  dem.altitude_m = Grid<float>(100, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 100; ++x)
      dem.altitude_m(x, y) = static_cast<float>(plane(dem.transform.to_crs(x, y)));
  return dem;
}

TEST(Surroundings, LieAroundTheWindowAsFarAsAskedAndAsThereIs) {
  const Dem whole = whole_plane();
  const GeoTransform transform{50000.0 + 20 * 90.0, 90000.0 - 2 * 90.0, 30.0, 30.0};
  Grid<float> own(60, 45);
  for (int y = 0; y < 45; ++y)
    for (int x = 0; x < 60; ++x)
      own(x, y) = static_cast<float>(1000.0 + plane(transform.to_crs(x, y)));
  const Surrounded all = surround(own, transform, whole, 600.0);
  EXPECT_EQ(all.left, 20);
  EXPECT_EQ(all.top, 6) << "the whole ends there";
  EXPECT_EQ(all.altitude_m.width(), 20 + 60 + 20);
  EXPECT_EQ(all.altitude_m.height(), 6 + 45 + 20);
  for (int y = 2; y < all.altitude_m.height(); ++y)
    for (int x = 0; x < all.altitude_m.width(); ++x) {
      const double higher = own.contains(x - all.left, y - all.top) ? 1000.0 : 0.0;
      EXPECT_NEAR(all.altitude_m(x, y), higher + plane(all.transform.to_crs(x, y)), 0.02)
          << x << ' ' << y;
    }
}

}  // namespace
}  // namespace belvedere
