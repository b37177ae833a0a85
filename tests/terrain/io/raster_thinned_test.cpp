#include "terrain/io/raster_thinned.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terrain/io/raster_io.h"
#include "tests/files.h"

namespace belvedere {
namespace {

TEST(RasterThinned, TakesCellsHereAndThereAsTheyStand) {
  const test::Folder folder;
  Raster<float> plane{
      Grid<float>(1000, 600), {600000.0, 5200000.0, 10.0, 10.0}, normalize_crs("EPSG:32632")};
  const auto altitude = [](glm::dvec2 at) {
    return 0.1 * (at.x - 600000.0) + 0.05 * (5200000.0 - at.y);
  };
  for (int y = 0; y < 600; ++y)
    for (int x = 0; x < 1000; ++x)
      plane.cells(x, y) =
          x < 200 ? NAN : static_cast<float>(altitude(plane.transform.to_crs(x, y)));
  write_raster(folder / "plane.tif", plane);
  RasterSource source;
  source.path = folder / "plane.tif";
  const auto thin = read_thinned(source, 100);
  ASSERT_TRUE(thin);
  EXPECT_EQ(thin->cells.width(), 100);
  EXPECT_EQ(thin->cells.height(), 60);
  EXPECT_EQ(thin->transform, (GeoTransform{600000.0, 5200000.0, 100.0, 100.0}));
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) {
      if (x < 20) {
        EXPECT_TRUE(std::isnan(thin->cells(x, y)));
      } else {
        // Some cell of the ten by ten below: at most 45 m away in each direction.
        EXPECT_NEAR(thin->cells(x, y), altitude(thin->transform.to_crs(x, y)),
                    0.1 * 50.0 + 0.05 * 50.0 + 1e-3);
      }
    }
  source.lowest_m = 400.0;
  EXPECT_TRUE(std::isnan(read_thinned(source, 100)->cells(30, 0)));
}

TEST(RasterThinned, SmallFilesAreThemselves) {
  const test::Folder folder;
  Raster<float> small{
      Grid<float>(40, 30, 7.F), {600000.0, 5200000.0, 10.0, 10.0}, normalize_crs("EPSG:32632")};
  small.cells(3, 4) = 11.F;
  write_raster(folder / "small.tif", small);
  RasterSource source;
  source.path = folder / "small.tif";
  EXPECT_EQ(read_thinned(source, 100)->cells, small.cells);
}

}  // namespace
}  // namespace belvedere
